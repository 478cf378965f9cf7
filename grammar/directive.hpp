// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

/// Everything that begins with '#'.
namespace abbe::grammar::rules {

struct DirectiveId;
struct ConditionalId;

/// Any directive; fails on `#else`, `#case`, `#end`, which end the list they stand in.
using DirectiveRule = x3::rule<DirectiveId, ast::Item>;
/// Those that have a body: #if #while #for #switch.
using ConditionalRule = x3::rule<ConditionalId, ast::Item>;

DirectiveRule const directive = "a directive";
ConditionalRule const conditional = "a directive";

BOOST_SPIRIT_DECLARE(DirectiveRule, ConditionalRule)

} // namespace abbe::grammar::rules
