// SPDX-License-Identifier: MIT
#include "grammar/item_def.hpp"

namespace abbe::grammar::rules {

BOOST_SPIRIT_INSTANTIATE(ItemsRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ArgumentRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(BodyRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ItemRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(BlockRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(OperandRule, Iterator, Context)

} // namespace abbe::grammar::rules
