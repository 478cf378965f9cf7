// SPDX-License-Identifier: MIT
#include "grammar/ast.hpp"

#include "grammar/lexer.hpp"

#include <algorithm>

namespace abbe::ast {

template <class... Node>
OneOf<Node...>::OneOf() = default;
template <class... Node>
OneOf<Node...>::OneOf(OneOf const&) = default;
template <class... Node>
OneOf<Node...>::OneOf(OneOf&&) noexcept = default;
template <class... Node>
OneOf<Node...>& OneOf<Node...>::operator=(OneOf const&) = default;
template <class... Node>
OneOf<Node...>& OneOf<Node...>::operator=(OneOf&&) noexcept = default;
template <class... Node>
OneOf<Node...>::~OneOf() = default;
template struct OneOf<Number, LiteralVector, Name, String, Box<Vector>, Box<Unary>, Box<Binary>,
                      Box<Conditional>, Box<Member>, Box<Index>, Box<Call>, Box<Paren>, Box<Array>,
                      Box<Function>, Box<Block>>;
template struct OneOf<Expr, Word, LiteralVectors, Bracket, Punctuation, Text, Box<If>, Box<While>,
                      Box<For>, Box<Switch>, Box<Declare>, Box<Macro>, Box<Directive>>;

LiteralVector LiteralVectors::operator[](std::size_t i) const {
  LiteralVector one;
  one.size = size;
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * size), size, one.values);
  std::string_view const text = span.source->text();
  grammar::Iterator const last = text.data() + text.size();
  grammar::Iterator at = text.data() + begin[i];
  // (The file may have changed under our eyes.)
  while (at < last && *at != '>')
    at = *at == '/' ? std::max(at + 1, grammar::skip_blanks(at, last)) : at + 1;
  one.span = {span.source, begin[i], static_cast<std::uint32_t>(at + 1 - text.data())};
  return one;
}

Span span_of(Expr const& expression) {
  return visit([](auto const& node) { return node.span; }, expression);
}

Span span_of(Item const& item) {
  return visit(
      [](auto const& node) -> Span {
        if constexpr (std::is_same_v<std::decay_t<decltype(node)>, Expr>)
          return span_of(node);
        else
          return node.span;
      },
      item);
}

} // namespace abbe::ast
