// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"

/// How to look into the nodes of ast.hpp, which includes this.
namespace abbe::ast {

/// Calls `f` with the node inside. Of an Item that is an expression, `f` gets the Expr. All calls
/// return the same type.
template <class Visitor, class Node>
decltype(auto) visit(Visitor&& f, Node&& node) {
  return detail::visit_from<0>(f, node.kinds);
}
/// The node if it is a T, else nullptr; of an Item that is an expression only the Expr.
template <class T, class Node>
auto get_direct(Node& node) -> std::conditional_t<std::is_const_v<Node>, T const*, T*> {
  auto* const found = std::get_if<detail::kind_of<T, typename Node::Kinds>>(&node.kinds);
  return found ? &detail::unwrap(*found) : nullptr;
}
/// The node if it is a T, else nullptr. An Item is looked into: get_if<Name>(item) finds the Name
/// in the Expr.
template <class T>
T const* get_if(Expr const& node) {
  return get_direct<T>(node);
}
template <class T>
T const* get_if(Item const& node) {
  if constexpr (!std::is_void_v<detail::kind_of<T, Item::Kinds>>) {
    return get_direct<T>(node);
  } else {
    Expr const* const expression = get_direct<Expr>(node);
    return expression ? get_direct<T>(*expression) : nullptr;
  }
}
/// Where a node, expression or item stands.
Span span_of(Expr const& expression);
Span span_of(Item const& item);

} // namespace abbe::ast
