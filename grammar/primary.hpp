// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/components.hpp"

/// Operands that begin with a name, their members, and the choice of an expression by flavour.
namespace abbe::grammar {

/// `.x` behind an operand: makes a Member of it; a '.' before a digit begins a number and is left
/// alone.
/// @throws SyntaxError E0115 for a name that is no component
void take_member(Iterator& at, Iterator last, State& state, ast::Expr& operand);

/// name, `name(arguments)`, `name[i][j]` or `name[i][j](arguments)`: reads the name once.
template <class Arguments, class Subscript>
struct NameLedParser
    : x3::binary_parser<Arguments, Subscript, NameLedParser<Arguments, Subscript>> {
  using x3::binary_parser<Arguments, Subscript, NameLedParser<Arguments, Subscript>>::binary_parser;
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    static constexpr NameOf callee(callee_names, Brace::Any, "a name");
    ast::Name name;
    Iterator at = first;
    if (!callee.parse(at, last, context, rcontext, name)) return false;
    State& state = state_of(context);
    bool const operand = name.reserved && word_kind(name.text) == WordKind::Operand;
    Iterator const next = skip_blanks(at, last);
    Iterator const begin = state.begin + name.span.begin;
    if (next != last && *next == '(' && !operand) {
      ast::Call call{{}, std::move(name), {}, {}};
      this->left.parse(at, last, context, rcontext, call.arguments);
      call.span = state.span(begin, at);
      out = std::move(call);
    } else if (next != last && *next == '[' && !name.reserved) {
      ast::Index index{{}, std::move(name), {}};
      do index.subscripts.emplace_back();
      while (this->right.parse(at, last, context, rcontext, index.subscripts.back()));
      index.subscripts.pop_back();
      index.span = state.span(begin, at);
      Iterator const behind = skip_blanks(at, last);
      if (behind != last && *behind == '(') {
        ast::Call call{{}, index.array, {}, {}};
        call.element.push_back(std::move(index));
        this->left.parse(at, last, context, rcontext, call.arguments);
        call.span = state.span(begin, at);
        out = std::move(call);
      } else {
        out = std::move(index);
      }
    } else {
      out = std::move(name);
    }
    first = at;
    return true;
  }
};
template <class Arguments, class Subscript>
constexpr auto name_led(Arguments const& arguments, Subscript const& subscript) {
  return NameLedParser<Arguments, Subscript>(arguments, subscript);
}

/// operand [ '.' component ]
template <class Subject>
struct MemberDirective : x3::unary_parser<Subject, MemberDirective<Subject>> {
  using x3::unary_parser<Subject, MemberDirective<Subject>>::unary_parser;
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    if (!this->subject.parse(first, last, context, rcontext, out)) return false;
    Iterator const at = skip_blanks(first, last);
    if (at != last && *at == '.') take_member(first, last, state_of(context), out);
    return true;
  }
};
template <class Subject>
constexpr auto with_member(Subject const& inner) {
  return MemberDirective<Subject>(inner);
}

/// The expression that state.flavour asks for.
template <class Bare, class Full, class Function>
struct FlavourParser : x3::parser<FlavourParser<Bare, Full, Function>> {
  constexpr FlavourParser(Bare const& bare, Full const& full, Function const& function)
      : bare_(bare), full_(full), function_(function) {}
  using attribute_type = ast::Expr;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Expr& out) const {
    switch (state_of(context).flavour) {
    case Flavour::Bare:
      return bare_.parse(first, last, context, rcontext, out);
    case Flavour::Full:
      return full_.parse(first, last, context, rcontext, out);
    case Flavour::Function:
      return function_.parse(first, last, context, rcontext, out);
    }
    return false;
  }
  Bare bare_;
  Full full_;
  Function function_;
};
template <class Bare, class Full, class Function>
constexpr auto by_flavour(Bare const& bare, Full const& full, Function const& function) {
  return FlavourParser<Bare, Full, Function>(bare, full, function);
}

} // namespace abbe::grammar
