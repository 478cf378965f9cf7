// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/declare_value.hpp"
#include "grammar/directive.hpp"
#include "grammar/expression.hpp"
#include "grammar/item.hpp"
#include "grammar/open_blocks.hpp"
#include "grammar/repeat_info.hpp"

namespace abbe::grammar::rules {

struct DeclareId : tag_span {};
struct MacroId : tag_lasting {};
struct PlainId : tag_open {
  template <class AnyContext>
  void on_success(Iterator const& first, Iterator const& end, ast::Directive& node,
                  AnyContext const& context) {
    tag_open::on_success(first, end, node, context);
    if (node.word == "include") state_of(context).loose = true;
  }
};

// ------------------------------------------------------------------------------------- arguments
x3::rule<struct ValueItemId, ast::Item> const value_item = "a value";
auto const value_item_def = operand;
x3::rule<struct ReferenceItemId, ast::Item> const reference_item = "a name";
auto const reference_item_def = reference;
x3::rule<struct WordItemId, ast::Item> const word_item = "'read', 'write' or 'append'";
auto const word_item_def = WordLiteral{};
x3::rule<struct PathItemId, ast::Item> const path_item = "a file name";
auto const path_item_def = path_operand(PathLiteral{}) | expression;
x3::rule<struct NewNameItemId, ast::Item> const handle_item = "the name of a file";
auto const handle_item_def = path_operand(NewName("the name of a file"));
x3::rule<struct BlockItemId, ast::Item> const block_item = "'{'";
auto const block_item_def = &mark('{') >> operand;

x3::rule<struct FopenId, ast::Items> const fopen_arguments = "the name of a file";
auto const fopen_arguments_def = handle_item > path_item > word_item;
auto const no_arguments = x3::attr(ast::Items{});
auto const in_parentheses = between('(', ')', "argument list", Flavour::Bare)[items];

auto const one_of = [](auto const& argument_parser) { return x3::repeat(1)[argument_parser]; };

// ------------------------------------------------------------------------------------- the plain
x3::rule<PlainId, ast::Directive> const plain = "a directive";
auto const plain_def = ((hash("include") > one_of(path_item))
                        | (hash("version", "debug", "warning", "error", "render", "statistics")
                           > one_of(value_item))
                        | (hash("undef", "fclose") > one_of(reference_item))
                        | (hash("default") > one_of(block_item)) | (hash("fopen") > fopen_arguments)
                        | (hash("read", "write") > in_parentheses) | (hash("break") > no_arguments))
                       >> -mark(';');

// ---------------------------------------------------------------------------- #declare and #macro
x3::rule<struct ScopeId, bool> const is_local = "'#declare'";
auto const is_local_def =
    (x3::omit[hash("local")] >> x3::attr(true)) | (x3::omit[hash("declare")] >> x3::attr(false));

x3::rule<struct TargetId, ast::Expr> const target = "a name to declare";
auto const target_def = index_ | NewName("a name");

x3::rule<DeclareId, ast::Declare> const declare = "'#declare'";
auto const declare_def = is_local > x3::matches[keyword("deprecated")]
                         > x3::matches[keyword("once")]
                         > (StringLiteral{} | x3::attr(ast::String{})) > target > mark('=')
                         > declare_value(operand, expression) > x3::matches[mark(';')]
                         > x3::omit[*mark(';')];

x3::rule<MacroId, ast::Macro> const macro = "'#macro'";
auto const macro_parameters =
    between('(', ')', "parameter list", Flavour::Bare)[*(NewName("a parameter") >> -mark(','))];
auto const macro_def =
    until_end[x3::omit[hash("macro")] > NewName("the name of a macro") > macro_parameters > body];

auto const directive_def = DirectiveAhead{}
                           >> (plain | declare | conditional | macro | UnknownDirective{});

BOOST_SPIRIT_DEFINE(directive, plain, declare, macro, value_item, reference_item, word_item,
                    path_item, handle_item, block_item, fopen_arguments, is_local, target)

} // namespace abbe::grammar::rules
