// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"

/// How to look into the nodes of ast.hpp, which includes this.
namespace abbe::ast {

namespace detail {
template <class T>
T const& unwrap(T const& node) {
  return node;
}
template <class T>
T& unwrap(T& node) {
  return node;
}
template <class T>
T const& unwrap(x3::forward_ast<T> const& node) {
  return node.get();
}
template <class T>
T& unwrap(x3::forward_ast<T>& node) {
  return node.get();
}
} // namespace detail

/// Calls `f` with the node inside (forward_ast unwrapped). Of an Item that is an expression, `f`
/// gets the Expr. All calls return the same type.
template <class Visitor, class Variant>
decltype(auto) visit(Visitor&& f, Variant&& v) {
  auto inner = [&f](auto& node) -> decltype(auto) { return f(detail::unwrap(node)); };
  return boost::apply_visitor(inner, v.get());
}
/// The node if it is a T, else nullptr. An Item is looked into: get_if<Name>(item) finds the Name
/// in the Expr.
template <class T, class Variant>
T const* get_if(Variant const& v) {
  if (T const* plain = boost::relaxed_get<T>(&v.get())) return plain;
  if (auto const* forward = boost::relaxed_get<x3::forward_ast<T>>(&v.get()))
    return forward->get_pointer();
  if constexpr (std::is_same_v<Variant, Item> && !std::is_same_v<T, Expr>)
    if (Expr const* expression = boost::relaxed_get<Expr>(&v.get())) return get_if<T>(*expression);
  return nullptr;
}
/// Where a node, expression or item stands.
Span span_of(Expr const& expression);
Span span_of(Item const& item);

// Lists of items grow by moving them: a copy would be a deep one.
static_assert(std::is_nothrow_move_constructible_v<Expr>);
static_assert(std::is_nothrow_move_constructible_v<Item>);

} // namespace abbe::ast
