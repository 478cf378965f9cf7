// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/components.hpp"

/// Bodies of directives: items where these are whole, else an ast::Text.
namespace abbe::grammar {

/// Does the directive at `at` end a body (`#else`, `#case`, `#end` ...)?
bool ends_body(Iterator at, Iterator last);
/// Finds the end of the body that begins at `at` by directives alone; null when nothing ends it.
Iterator find_end_of_body(Iterator at, Iterator last);
/// Behind the ')' of the '(' at `at`; `end` when these are not there.
Iterator find_end_of_question(Iterator at, Iterator end);
/// Is the error one that a text may have that is not executed? A comment or string without end, or
/// nesting beyond limits, is not.
bool may_be_text(SyntaxError const& error);

/// Holds the part of the state that an error leaves changed.
struct Place {
  explicit Place(State const& state)
      : flavour(state.flavour),
        depth(state.depth),
        height(state.height),
        brackets(state.brackets),
        bracket(state.bracket),
        braces(state.braces),
        directives(state.directives) {}
  void restore(State& state) const {
    state.flavour = flavour;
    state.depth = depth;
    state.height = height;
    state.brackets = brackets;
    state.bracket = bracket;
    state.braces = braces;
    state.directives = directives;
    state.closed = true;
  }
  Flavour flavour;
  int depth, height, brackets;
  char bracket;
  int braces, directives;
};

template <class Subject>
struct BodyDirective : x3::unary_parser<Subject, BodyDirective<Subject>> {
  using x3::unary_parser<Subject, BodyDirective<Subject>>::unary_parser;
  using attribute_type = ast::Items;
  static bool const has_attribute = true;
  static bool const handles_container = true;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Items& items) const {
    State& state = state_of(context);
    bool const flat = std::exchange(state.flat, false);
    bool const whole = read_whole(first, last, context, rcontext, items);
    state.flat = flat;
    return whole || take_text(first, last, state, items);
  }

private:
  /// @return false when the items are not whole but may be a text; all is as it was
  template <class AnyContext, class RContext>
  [[gnu::noinline]] bool read_whole(Iterator& first, Iterator const& last,
                                    AnyContext const& context, RContext& rcontext,
                                    ast::Items& items) const {
    State& state = state_of(context);
    Place const before(state);
    Iterator at = first;
    try {
      this->subject.parse(at, last, context, rcontext, items);
      if (ends_body(at, last) || find_end_of_body(first, last) == nullptr) {
        first = at;
        return true;
      }
    } catch (SyntaxError const& error) {
      if (!may_be_text(error) || find_end_of_body(first, last) == nullptr) throw;
    } catch (x3::expectation_failure<Iterator> const&) {
      if (find_end_of_body(first, last) == nullptr) throw;
    }
    before.restore(state);
    return false;
  }

  [[gnu::noinline]] static bool take_text(Iterator& first, Iterator last, State& state,
                                          ast::Items& items) {
    Iterator const begin = skip_blanks(first, last);
    first = find_end_of_body(begin, last);
    items.clear();
    items.emplace_back(ast::Text{state.span(begin, first)});
    state.loose = true;
    return true;
  }
};

/// What `#elseif`, `#case` and `#range` ask for. It need not be whole where it is never asked: what
/// is not becomes a Paren that holds an ast::Text, with the body when no ')' ends it.
template <class Subject>
struct QuestionDirective : x3::unary_parser<Subject, QuestionDirective<Subject>>, Labelled {
  using x3::unary_parser<Subject, QuestionDirective<Subject>>::unary_parser;
  static bool const is_pass_through_unary = true;
  static bool const handles_container = Subject::handles_container;

  template <class AnyContext, class RContext, class Attribute>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             Attribute& out) const {
    State& state = state_of(context);
    Place const before(state);
    Iterator at = first;
    try {
      if (this->subject.parse(at, last, context, rcontext, out)) {
        first = at;
        return true;
      }
    } catch (SyntaxError const& error) {
      if (!may_be_text(error) || find_end_of_body(first, last) == nullptr) throw;
    } catch (x3::expectation_failure<Iterator> const&) {
      if (find_end_of_body(first, last) == nullptr) throw;
    }
    Iterator end = find_end_of_body(first, last);
    if (end == nullptr) return false;
    end = find_end_of_question(first, end);
    before.restore(state);
    Span const span = state.span(skip_blanks(first, last), end);
    first = end;
    put(ast::Expr(ast::Paren{span, {ast::Item(ast::Text{span})}}), out);
    return true;
  }
  std::string label() const { return "'('"; }

private:
  static void put(ast::Expr text, ast::Expr& out) { out = std::move(text); }
  static void put(ast::Expr const& text, std::vector<ast::Expr>& out) { out = {text, text}; }
};
template <class Subject>
constexpr auto question(Subject const& inner) {
  return QuestionDirective<Subject>(inner);
}

template <class Subject>
constexpr auto body_of(Subject const& inner) {
  using Parser = typename x3::extension::as_parser<Subject>::value_type;
  return BodyDirective<Parser>(x3::as_parser(inner));
}

} // namespace abbe::grammar
