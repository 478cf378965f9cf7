// SPDX-License-Identifier: MIT
#include "grammar/ast.hpp"

namespace abbe::ast {

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
