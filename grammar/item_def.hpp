// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/body.hpp"
#include "grammar/directive.hpp"
#include "grammar/expression.hpp"
#include "grammar/item.hpp"
#include "grammar/open_blocks.hpp"
#include "grammar/operators.hpp"
#include "grammar/repeat_info.hpp"

namespace abbe::grammar::rules {

struct BlockId : tag_open {};
struct BareBlockId : tag_open {};
struct BracketId : tag_span {};
struct ArrayId : tag_span {};
struct FunctionId : tag_lasting {};

// -------------------------------------------------------------------------------------- blocks
auto const braces = between('{', '}', "block", Flavour::Bare)[items];
constexpr auto head = NameOf(head_names, Brace::Follows, "a block");
auto const block_def = head >> braces;

x3::rule<BareBlockId, ast::Block> const bare_block = "'{'";
auto const bare_block_def = into(&ast::Block::items)[braces];

x3::rule<BracketId, ast::Bracket> const bracket = "'['";
auto const bracket_def =
    into(&ast::Bracket::items)[between('[', ']', "bracket", Flavour::Bare)[items]];

x3::rule<ArrayId, ast::Array> const array = "an array";
auto const size = between('[', ']', "size of an array", Flavour::Bare)[expression];
auto const array_def = keyword("array") > +size > x3::matches[&mark('{')] > -braces;

// ------------------------------------------------------------------------------------ functions
x3::rule<FunctionId, ast::Function> const function = "a function";
constexpr auto parameter = NameOf(operand_names, Brace::Any, "a parameter");
auto const parameters =
    between('(', ')', "parameter list", Flavour::Bare)[-(parameter % -mark(','))];
auto const function_def = keyword("function") > x3::matches[&mark('(')] > -parameters
                          > *(expression >> -mark(','))
                          > between('{', '}', "function", Flavour::Function)[items];

// ---------------------------------------------------------------------------------------- items
auto const operand_def = outlined<ast::Expr>(function | array | block | bare_block) | expression;

auto const item_def = outlined<ast::Item>(directive) | outlined<ast::Item>(operand)
                      | outlined<ast::Item>(WordLiteral{} | bracket | PunctuationLiteral{});

auto const items_def = list_of(item, braces);
auto const argument_def = +item;
auto const body_def = body_of(items);

BOOST_SPIRIT_DEFINE(items, argument, body, block, operand, item, bare_block, bracket, array,
                    function)

} // namespace abbe::grammar::rules
