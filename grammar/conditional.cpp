// SPDX-License-Identifier: MIT
#include "grammar/conditional_def.hpp"

namespace abbe::grammar::rules {

BOOST_SPIRIT_INSTANTIATE(ConditionalRule, Iterator, Context)

} // namespace abbe::grammar::rules
