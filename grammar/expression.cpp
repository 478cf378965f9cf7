// SPDX-License-Identifier: MIT
#include "grammar/expression_def.hpp"

namespace abbe::grammar::rules {

BOOST_SPIRIT_INSTANTIATE(PostfixRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ExpressionRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(FullRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ReferenceRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(IndexRule, Iterator, Context)
BOOST_SPIRIT_INSTANTIATE(ParenRule, Iterator, Context)

} // namespace abbe::grammar::rules
