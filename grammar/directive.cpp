// SPDX-License-Identifier: MIT
#include "grammar/directive_def.hpp"

namespace abbe::grammar::rules {

BOOST_SPIRIT_INSTANTIATE(DirectiveRule, Iterator, Context)

} // namespace abbe::grammar::rules
