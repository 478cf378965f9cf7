// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

/// Expressions. `expression` is the one that fits the place: state.flavour tells.
namespace abbe::grammar::rules {

struct PostfixId;
struct ExpressionId;
struct FullId;
struct ReferenceId;
struct IndexId;
struct ParenId;

/// One operand with its `.x`.
using PostfixRule = x3::rule<PostfixId, ast::Expr>;
/// `a + b`, or with all operators inside parentheses and function bodies.
using ExpressionRule = x3::rule<ExpressionId, ast::Expr>;
/// With all operators, whatever the place.
using FullRule = x3::rule<FullId, ast::Expr>;
/// A name or an element of an array: what can be declared, undefined, tested by #ifdef.
using ReferenceRule = x3::rule<ReferenceId, ast::Expr>;
using IndexRule = x3::rule<IndexId, ast::Index>;
using ParenRule = x3::rule<ParenId, ast::Paren>;

PostfixRule const postfix = "a value";
ExpressionRule const expression = "a value";
FullRule const full_expression = "a value";
ReferenceRule const reference = "a name";
IndexRule const index_ = "an array element";
ParenRule const paren = "'('";

BOOST_SPIRIT_DECLARE(PostfixRule, ExpressionRule, FullRule, ReferenceRule, IndexRule, ParenRule)

} // namespace abbe::grammar::rules
