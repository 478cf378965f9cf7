// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/components.hpp"

/// `#if` whose branches open a block that is closed behind `#end`: see ast::If::open_blocks.
namespace abbe::grammar {

/// Sets `span`, and `open` when the node's bracket was left open.
struct tag_open : tag_span {
  template <class Node, class AnyContext>
  void on_success(Iterator const& first, Iterator const& end, Node& node,
                  AnyContext const& context) {
    tag_span::on_success(first, end, node, context);
    node.open = !std::exchange(state_of(context).closed, true);
  }
};

/// One `First`, then any number of `More`, into one list.
template <class First, class More>
struct FirstThenParser : x3::binary_parser<First, More, FirstThenParser<First, More>> {
  using x3::binary_parser<First, More, FirstThenParser<First, More>>::binary_parser;
  using attribute_type = std::vector<typename x3::traits::attribute_of<First, Context>::type>;
  static bool const has_attribute = true;
  static bool const handles_container = true;

  template <class AnyContext, class RContext, class List>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             List& out) const {
    typename List::value_type node;
    if (!this->left.parse(first, last, context, rcontext, node)) return false;
    do {
      out.push_back(std::move(node));
      node = {};
    } while (this->right.parse(first, last, context, rcontext, node));
    return true;
  }
};
template <class First, class More>
constexpr auto first_then(First const& first, More const& more) {
  return FirstThenParser<First, More>(first, more);
}

/// The #if, then the rest of the block that it left open.
template <class Subject, class Tail>
struct TailDirective : x3::binary_parser<Subject, Tail, TailDirective<Subject, Tail>> {
  using x3::binary_parser<Subject, Tail, TailDirective<Subject, Tail>>::binary_parser;
  using attribute_type = ast::If;
  static bool const has_attribute = true;
  static bool const handles_container = false;

  template <class AnyContext, class RContext>
  bool parse(Iterator& first, Iterator const& last, AnyContext const& context, RContext& rcontext,
             ast::If& node) const {
    Iterator const begin = skip_blanks(first, last);
    State& state = state_of(context);
    if (!state.structure && directive_at(begin, last).starts_with("if"))
      state.make_structure(begin);
    if (!this->left.parse(first, last, context, rcontext, node)) return false;
    if (!state.structure->tails.contains(begin)) return true;
    node.open_blocks = 1;
    Nest nest(state, begin);
    ++state.brackets;
    ++state.braces;
    this->right.parse(first, last, context, rcontext, node.tail);
    first = skip_blanks(first, last);
    if (first == last || *first != '}')
      throw_unclosed("}", "block", begin, next_token(begin, last).end, first, last);
    ++first;
    --state.brackets;
    --state.braces;
    nest.leave();
    return true;
  }
};
template <class Subject, class Tail>
constexpr auto with_tail(Subject const& subject, Tail const& tail) {
  return TailDirective<Subject, Tail>(subject, tail);
}

} // namespace abbe::grammar
