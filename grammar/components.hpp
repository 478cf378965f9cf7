// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/plain_items.hpp"

/// X3 directives (parsers around a parser) for what recurs in this grammar: lists, brackets, bodies
/// and chains of operators. They stand where other grammars need semantic actions.
namespace abbe::grammar {

/// @throws SyntaxError E0110 "expected <what>, found <the token at `at`>"
[[noreturn]] void throw_expected(std::string const& what, Iterator at, Iterator last);
/// @throws SyntaxError E0111 "expected '}' to close the block opened here, found ..."
[[noreturn]] void throw_unclosed(char const* closer, char const* what, Iterator opener,
                                 Iterator opener_end, Iterator at, Iterator last);
/// @throws SyntaxError E0701, E0702
[[noreturn]] void throw_too_deep(Iterator at);
[[noreturn]] void throw_too_high(Iterator begin, Iterator end);
/// See Structure.
inline bool may_stay_open(State const& state, Iterator opener, Iterator at) {
  if (state.loose && at == state.end && *opener == '{') return true;
  return state.structure && state.structure->open.contains(opener);
}
inline bool closes_other(State const& state, Iterator closer) {
  return state.structure && state.structure->close.contains(closer);
}

inline std::size_t stack_distance(char const* start, char const* here) {
  auto const a = reinterpret_cast<std::uintptr_t>(start);
  auto const b = reinterpret_cast<std::uintptr_t>(here);
  return a > b ? a - b : b - a;
}

/// One level deeper. Restores depth unless an exception passes.
struct Nest {
  Nest(State& state, Iterator at) : state_(state) {
    char here = 0;
    if (++state.depth > max_nesting || stack_distance(state.stack_start, &here) > max_stack)
      throw_too_deep(at);
    if (state.height < state.depth) state.height = state.depth;
  }
  void leave() { --state_.depth; }
  State& state_;
};

/// A '#' before something that is no directive and not like one (`#union {`): POV-Ray passes over
/// it, and a scene of its own has one.
inline bool at_lone_hash(Iterator at, Iterator last) {
  return *at == '#' && is_no_directive(directive_at(at, last));
}

/// Items with any commas between and around them: plain ones, blocks `head { ... }`, whose braces
/// `Braces` reads, and whatever else `Subject` reads.
template <class Subject, class Braces>
struct ListDirective : x3::binary_parser<Subject, Braces, ListDirective<Subject, Braces>> {
  using x3::binary_parser<Subject, Braces, ListDirective<Subject, Braces>>::binary_parser;
  using attribute_type = ast::Items;
  static bool const has_attribute = true;
  static bool const handles_container = true;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::Items& items) const {
    State& state = state_of(context);
    for (;;) {
      first = skip_blanks(first, last);
      while (first != last && (*first == ',' || at_lone_hash(first, last)))
        first = skip_blanks(first + 1, last);
      if (first != last) {
        if (first >= state.pause && static_cast<void const*>(&items) == state.statements)
          return true;
        if (closes_list(first, state)) return true;
        if (*first == '<' && scan_vectors(first, last, state, items)) continue;
      }
      if (items.capacity() == 0) items.reserve(usual_length);
      items.emplace_back();
      switch (scan_plain(first, last, state, items.back())) {
      case Plain::Taken:
        break;
      case Plain::Block:
        parse_block(first, last, context, rcontext,
                    *ast::get_direct<ast::Block>(*ast::get_direct<ast::Expr>(items.back())));
        break;
      case Plain::No:
        if (this->left.parse(first, last, context, rcontext, items.back())) break;
        items.pop_back();
        return true;
      }
    }
  }

private:
  static constexpr std::size_t usual_length = 4;

  template <class AnyContext, class RContext>
  void parse_block(Iterator& first, Iterator const& last, AnyContext const& context,
                   RContext& rcontext, ast::Block& block) const {
    State& state = state_of(context);
    this->right.parse(first, last, context, rcontext, block.items);
    block.span = state.span(state.begin + block.head.span.begin, first);
    block.open = !std::exchange(state.closed, true);
  }
};

/// The subject between an opening and a closing mark, read in the given flavour.
template <class Subject>
struct BracketDirective : x3::unary_parser<Subject, BracketDirective<Subject>>, Labelled {
  constexpr BracketDirective(Subject const& inner, char open, char close, char const* what,
                             Flavour flavour)
      : x3::unary_parser<Subject, BracketDirective<Subject>>(inner),
        open_(open),
        close_{close},
        what_(what),
        flavour_(flavour) {}
  static bool const is_pass_through_unary = true;
  static bool const handles_container = Subject::handles_container;

  template <class AnyContext, class RContext, class Actual>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             Actual& actual) const {
    Iterator at = skip_blanks(first, last);
    if (at == last || *at != open_) return false;
    Iterator const opener = at++;
    State& state = state_of(context);
    Nest nest(state, opener);
    bool const block = open_ == '{';
    Flavour const flavour = state.flavour;
    state.flavour = flavour == Flavour::Function && open_ == '(' ? flavour : flavour_;
    char const outer_bracket = std::exchange(state.bracket, open_);
    ++state.brackets;
    state.braces += block;
    if (!this->subject.parse(at, last, context, rcontext, actual)) throw_expected(what_, at, last);
    at = skip_blanks(at, last);
    bool const closed = at != last && *at == close_[0] && !closes_other(state, at)
                        && !(state.structure && state.structure->open.contains(opener));
    if (closed)
      ++at;
    else if (!may_stay_open(state, opener, at))
      throw_unclosed(close_, what_, opener, opener + 1, at, last);
    state.closed = closed;
    state.bracket = outer_bracket;
    state.flavour = flavour;
    --state.brackets;
    state.braces -= block;
    nest.leave();
    first = at;
    return true;
  }
  std::string label() const { return {'\'', open_, '\''}; }
  char open_;
  char close_[2];
  char const* what_;
  Flavour flavour_;
};

/// `between('{', '}', "block", Flavour::Bare)[items]`.
struct BracketMaker {
  template <class Subject>
  constexpr auto operator[](Subject const& inner) const {
    using Parser = typename x3::extension::as_parser<Subject>::value_type;
    return BracketDirective<Parser>(x3::as_parser(inner), open, close, what, flavour);
  }
  char open;
  char close;
  char const* what;
  Flavour flavour;
};
constexpr BracketMaker between(char open, char close, char const* what, Flavour flavour) {
  return {open, close, what, flavour};
}

/// A directive from its word to its `#end`.
template <class Subject>
struct UntilEndDirective : x3::unary_parser<Subject, UntilEndDirective<Subject>> {
  using x3::unary_parser<Subject, UntilEndDirective<Subject>>::unary_parser;
  static bool const is_pass_through_unary = true;
  static bool const handles_container = Subject::handles_container;

  template <class AnyContext, class RContext, class Actual>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             Actual& actual) const {
    Iterator at = skip_blanks(first, last);
    if (at == last || *at != '#') return false;
    Iterator const opener = at;
    State& state = state_of(context);
    Nest nest(state, opener);
    ++state.directives;
    if (!this->subject.parse(at, last, context, rcontext, actual)) {
      --state.directives;
      nest.leave();
      return false;
    }
    Iterator const end = skip_blanks(at, last);
    std::string_view const word = directive_at(end, last);
    if (word != "end")
      throw_unclosed("#end", "directive", opener, next_token(opener, last).end, end, last);
    --state.directives;
    nest.leave();
    first = word.data() + word.size();
    return true;
  }
};
struct UntilEndMaker {
  template <class Subject>
  constexpr auto operator[](Subject const& inner) const {
    using Parser = typename x3::extension::as_parser<Subject>::value_type;
    return UntilEndDirective<Parser>(x3::as_parser(inner));
  }
};
inline constexpr UntilEndMaker until_end{};

/// Puts the subject's attribute into one member: for nodes that have only one.
template <class Node, class Member, class Subject>
struct IntoDirective : x3::unary_parser<Subject, IntoDirective<Node, Member, Subject>> {
  constexpr IntoDirective(Subject const& inner, Member Node::*member)
      : x3::unary_parser<Subject, IntoDirective>(inner), member_(member) {}
  using attribute_type = Node;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             Node& node) const {
    return this->subject.parse(first, last, context, rcontext, node.*member_);
  }
  Member Node::*member_;
};
template <class Node, class Member>
struct IntoMaker {
  template <class Subject>
  constexpr auto operator[](Subject const& inner) const {
    using Parser = typename x3::extension::as_parser<Subject>::value_type;
    return IntoDirective<Node, Member, Parser>(x3::as_parser(inner), member);
  }
  Member Node::*member;
};
template <class Node, class Member>
constexpr IntoMaker<Node, Member> into(Member Node::*member) {
  return {member};
}

/// Parses in a stack frame of its own: keeps the temporaries of leaves out of the frames that recur
/// with every level of nesting.
template <class Attribute, class Subject>
struct OutlinedDirective : x3::unary_parser<Subject, OutlinedDirective<Attribute, Subject>> {
  using x3::unary_parser<Subject, OutlinedDirective<Attribute, Subject>>::unary_parser;
  using attribute_type = Attribute;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  [[gnu::noinline]] bool parse(Iterator& first, Iterator const& last, AnyContext const& context,
                               RContext& rcontext, Attribute& actual) const {
    return this->subject.parse(first, last, context, rcontext, actual);
  }
};
template <class Attribute, class Subject>
constexpr auto outlined(Subject const& inner) {
  using Parser = typename x3::extension::as_parser<Subject>::value_type;
  return OutlinedDirective<Attribute, Parser>(x3::as_parser(inner));
}

template <class Subject, class Braces>
constexpr auto list_of(Subject const& inner, Braces const& braces) {
  using Parser = typename x3::extension::as_parser<Subject>::value_type;
  return ListDirective<Parser, Braces>(x3::as_parser(inner), braces);
}

} // namespace abbe::grammar

namespace boost::spirit::x3::traits {
template <class Subject, class Braces, class Context>
struct attribute_of<abbe::grammar::ListDirective<Subject, Braces>, Context> {
  using type = abbe::ast::Items;
};
} // namespace boost::spirit::x3::traits
