// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Bounding volume hierarchy over boxes, built top-down by binned surface area heuristic. The build
/// depends on the boxes alone: the same tree on every machine and run.
namespace abbe::geometry {

struct BvhNode {
  Vec3 low, high;
  std::uint32_t first = 0; ///< leaf: first place in items; else the right child (left is the next)
  std::uint32_t count = 0; ///< items of a leaf, 0 for an inner node
};

/// What a hierarchy is built from. Finite, not empty.
struct BvhBox {
  BvhBox(Vec3 const& low, Vec3 const& high, std::uint32_t number)
      : side{low.x, low.y, low.z, -high.x, -high.y, -high.z}, item(number) {}
  /// The low corner and the negated high one: what grows a box is six times the same minimum, which
  /// compilers make three vector operations of.
  double side[6];
  std::uint32_t item;
  double centre(int axis) const { return side[axis] * 0.5 - side[axis + 3] * 0.5; }
  Vec3 centre() const { return {centre(0), centre(1), centre(2)}; }
};

class Bvh {
public:
  Bvh() = default;
  /// @param leaf_size items below which a node is not split
  explicit Bvh(std::vector<BvhBox> boxes, std::uint32_t leaf_size = 2);

  std::vector<BvhNode> const& nodes() const { return nodes_; }
  std::vector<std::uint32_t> const& items() const { return items_; }

private:
  std::vector<BvhNode> nodes_;
  std::vector<std::uint32_t> items_;
};

/// Deepest tree that is built; below, items share a leaf.
inline constexpr int max_bvh_depth = 64;

/// A line against boxes: 1 / direction once, and the widening that makes the test conservative:
/// each bound has three roundings (pbrt 6.8.2).
struct BoxProbe {
  Vec3 low_origin, high_origin, inverse;
  explicit BoxProbe(Ray const& ray)
      : low_origin(ray.origin), high_origin(ray.origin), inverse(1.0 / ray.direction) {}
  /// The boxes wider by `reach` on each side.
  BoxProbe(Ray const& ray, Vec3 const& reach)
      : low_origin(ray.origin + reach),
        high_origin(ray.origin - reach),
        inverse(1.0 / ray.direction) {}

  /// Where the line is in the box within [from, to]: the entry, or false.
  template <class V>
  bool enter(V const& low, V const& high, double from, double to, double& entry) const {
    constexpr double wide = 1 + 2 * gamma_bound(3), tight = 1 - 2 * gamma_bound(3);
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    for (int i = 0; i < 3; ++i) {
      bool const rising = inverse[i] > 0;
      double const near = (rising ? low[i] - low_origin[i] : high[i] - high_origin[i]) * inverse[i];
      double const far = (rising ? high[i] - high_origin[i] : low[i] - low_origin[i]) * inverse[i];
      in = near > in ? near : in; // false for NaN: a line in the face's plane is not rejected
      out = far < out ? far : out;
    }
    // Rounding errors are relative: the widening does not change which is the last, or the first.
    in *= in < 0 ? wide : tight;
    out *= out < 0 ? tight : wide;
    entry = in > from ? in : from;
    return entry <= (out < to ? out : to);
  }
};

/// Calls visit(item) for the items whose box the line meets in [from, to], roughly front to back;
/// `to` may shrink meanwhile. visit returns false to stop. Node: {low, high, first, count}; Probe:
/// BoxProbe, or what has its enter().
template <class Node, class Probe, class Visit>
void walk(std::span<Node const> nodes, std::span<std::uint32_t const> items, Probe const& probe,
          double from, double const& to, Visit&& visit) {
  struct Waiting {
    std::uint32_t node;
    double entry;
  };
  std::array<Waiting, max_bvh_depth + 2> stack;
  std::size_t waiting = 0;
  double entry = 0;
  if (nodes.empty() || !probe.enter(nodes[0].low, nodes[0].high, from, to, entry)) return;
  stack[waiting++] = {0, entry};
  while (waiting > 0) {
    Waiting const top = stack[--waiting];
    if (top.entry > to) continue;
    Node const& node = nodes[top.node];
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) {
        std::uint32_t const place = node.first + i;
        if (!visit(items.empty() ? place : items[place])) return;
      }
      continue;
    }
    Waiting left{top.node + 1, 0}, right{node.first, 0};
    bool const at_left =
        probe.enter(nodes[left.node].low, nodes[left.node].high, from, to, left.entry);
    bool const at_right =
        probe.enter(nodes[right.node].low, nodes[right.node].high, from, to, right.entry);
    if (at_left && at_right) {
      bool const left_first = left.entry <= right.entry;
      stack[waiting++] = left_first ? right : left;
      stack[waiting++] = left_first ? left : right;
    } else if (at_left) {
      stack[waiting++] = left;
    } else if (at_right) {
      stack[waiting++] = right;
    }
  }
}

} // namespace abbe::geometry
