// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/expression.hpp"
#include "grammar/item.hpp"
#include "grammar/operators.hpp"
#include "grammar/primary.hpp"

namespace abbe::grammar::rules {

struct VectorId : tag_span {};
struct IndexId : tag_span {};
struct ParenId : tag_span {};

// ------------------------------------------------------------------------------------ operands
x3::rule<VectorId, ast::Vector> const vector_ = "a vector";
auto const vector__def =
    into(&ast::Vector::components)[between('<', '>', "vector", Flavour::Bare)[items]];

auto const paren_def =
    into(&ast::Paren::items)[between('(', ')', "parenthesis", Flavour::Full)[items]];

constexpr auto array_name = NameOf(plain_names, Brace::Any, "a name");
auto const subscript = between('[', ']', "subscript", Flavour::Bare)[expression];
auto const index__def = array_name >> +subscript;

constexpr auto name = NameOf(operand_names, Brace::Any, "a name");
auto const reference_def = index_ | name;

auto const arguments =
    between('(', ')', "argument list", Flavour::Bare)[-(argument % mark(',') >> -mark(','))];

auto const literal = NumberLiteral{} | LiteralVector{} | StringLiteral{};
auto const postfix_def =
    with_member(outlined<ast::Expr>(literal) | outlined<ast::Expr>(name_led(arguments, subscript))
                | outlined<ast::Expr>(paren | vector_));

// ----------------------------------------------------------------------------------- operators
auto const unary = prefixed(postfix);
auto const sum = chain(Level::Add, chain(Level::Multiply, unary));

auto const bare_choice = ternary(sum, expression);

auto const relation = chain(Level::Relation, sum);
auto const full_expression_def = ternary(chain(Level::Logic, relation), full_expression);

auto const function_relation = chain(Level::Relation, sum, Grouping::Right);
auto const function_expression = chain(Level::Or, chain(Level::And, function_relation));

auto const expression_def = by_flavour(bare_choice, full_expression, function_expression);

BOOST_SPIRIT_DEFINE(postfix, expression, full_expression, reference, index_, paren, vector_)

} // namespace abbe::grammar::rules
