// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

/// Box and OneOf: the parts of a node of the tree that is one of several kinds.
namespace abbe::ast {

/// Owns a T, which may be incomplete until one is made, and copies it with itself.
template <class T>
class Box {
public:
  explicit Box(T node) : node_(new T(std::move(node))) {}
  Box(Box const& other) : node_(new T(*other.node_)) {}
  Box(Box&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  Box& operator=(Box other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Box() { delete node_; }
  T& get() { return *node_; }
  T const& get() const { return *node_; }

private:
  T* node_;
};

namespace detail {

template <class T, class Kinds>
struct KindOf;
/// How the variant holds a T: as it is, boxed, or not at all (void).
template <class T, class... Kinds>
struct KindOf<T, std::variant<Kinds...>> {
  using type =
      std::conditional_t<(std::is_same_v<T, Kinds> || ...), T,
                         std::conditional_t<(std::is_same_v<Box<T>, Kinds> || ...), Box<T>, void>>;
};
template <class T, class Kinds>
using kind_of = typename KindOf<T, Kinds>::type;

template <class T>
T& unwrap(T& node) {
  return node;
}
template <class T>
T& unwrap(Box<T>& box) {
  return box.get();
}
template <class T>
T const& unwrap(Box<T> const& box) {
  return box.get();
}

template <std::size_t I, class Visitor, class Kinds>
decltype(auto) visit_from(Visitor& f, Kinds& kinds) {
  if constexpr (I + 1 < std::variant_size_v<std::remove_const_t<Kinds>>)
    if (kinds.index() != I) return visit_from<I + 1>(f, kinds);
  return f(unwrap(*std::get_if<I>(&kinds)));
}

} // namespace detail

/// One of several kinds of node, each as it is or in a Box. What copies, moves and destroys them is
/// compiled once (ast.cpp): files that handle nodes need not know how.
template <class... Node>
struct OneOf {
  using Kinds = std::variant<Node...>;
  template <class T, class Kind = detail::kind_of<T, Kinds>>
  requires(!std::is_void_v<Kind>) OneOf(T node)
      : kinds(std::in_place_type<Kind>, std::move(node)) {}
  OneOf();
  OneOf(OneOf const&);
  OneOf(OneOf&&) noexcept;
  OneOf& operator=(OneOf const&);
  OneOf& operator=(OneOf&&) noexcept;
  ~OneOf();

  Kinds kinds;
};
} // namespace abbe::ast
