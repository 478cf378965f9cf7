// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/components.hpp"

/// Where the value of a #declare ends, for ';' is optional after blocks and strings; and other
/// parsers that only directives need.
namespace abbe::grammar {

/// Does `texture {` stand at `at`?
bool at_texture(Iterator at, Iterator last);

/// One of
/// - `texture {...} texture {...}`: layers, as long as they follow each other directly;
/// - an operand, then perhaps colour words and values: `White filter .5`;
/// - a word, then words and values: `rgb <1,0,0> filter .5`, `transform Tr`;
/// - nothing, before a directive or in a text that is not whole: see ast::Declare::value.
template <class Operand, class Expression>
struct DeclareValueParser : x3::parser<DeclareValueParser<Operand, Expression>>, Labelled {
  constexpr DeclareValueParser(Operand const& operand, Expression const& expression)
      : operand_(operand), expression_(expression) {}
  using attribute_type = ast::Items;
  static bool const has_attribute = true;
  static bool const handles_container = true;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Items& out) const {
    auto const take = [&](auto const& part, auto node) {
      if (!part.parse(first, last, context, rcontext, node)) return false;
      out.emplace_back(std::move(node));
      return true;
    };
    Iterator const at = skip_blanks(first, last);
    if (state_of(context).flat || (at != last && *at == '#')) return true;
    bool const layered = at_texture(at, last);
    if (take(operand_, ast::Expr{})) {
      if (layered)
        while (at_texture(skip_blanks(first, last), last) && take(operand_, ast::Expr{})) {
        }
      bool coloured = false;
      for (;;) {
        if (take(WordLiteral(true), ast::Word{}))
          coloured = true;
        else if (!coloured || !take(expression_, ast::Expr{}))
          return true;
      }
    }
    if (take(WordLiteral{}, ast::Word{})) {
      while (take(WordLiteral{}, ast::Word{}) || take(expression_, ast::Expr{})) {
      }
      return true;
    }
    return false;
  }
  std::string label() const { return "a value"; }
  Operand operand_;
  Expression expression_;
};
template <class Operand, class Expression>
constexpr auto declare_value(Operand const& operand, Expression const& expression) {
  return DeclareValueParser<Operand, Expression>(operand, expression);
}

/// Leaves as expressions: an Item holds them that way.
template <class Subject>
struct OperandDirective : x3::unary_parser<Subject, OperandDirective<Subject>> {
  using x3::unary_parser<Subject, OperandDirective<Subject>>::unary_parser;
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext, class Actual>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             Actual& out) const {
    typename Subject::attribute_type node;
    if (!this->subject.parse(first, last, context, rcontext, node)) return false;
    out = ast::Expr(std::move(node));
    return true;
  }
};
template <class Subject>
constexpr auto path_operand(Subject const& inner) {
  return OperandDirective<Subject>(inner);
}

/// Can a directive begin here? Spares the others the trouble.
struct DirectiveAhead : Terminal<DirectiveAhead, x3::unused_type> {
  bool scan(Iterator& at, Iterator, State& state, x3::unused_type) const {
    return *at == '#' || (state.brackets == 0 && (*at == 'd' || *at == 'i' || *at == 'v'));
  }
  std::string label() const { return "a directive"; }
};

/// Fails at the words that end a list. @throws SyntaxError E0113 at any other '#'
struct UnknownDirective : Terminal<UnknownDirective, ast::Word> {
  bool scan(Iterator& at, Iterator last, State& state, ast::Word& out) const;
  std::string label() const { return "a directive"; }
};

} // namespace abbe::grammar
