// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh_space.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Bounding volume hierarchy over boxes, built top-down by binned surface area heuristic. The build
/// depends on the boxes alone: the same tree on every machine and run.
namespace abbe::geometry {

/// Two boxes side by side, and what is in each: one line of the cache, and one look for both.
struct alignas(64) BvhNode {
  /// Low corners, then high ones; by axis; of either box.
  float planes[2][3][2];
  /// Of a leaf the first place in items; else the node.
  std::uint32_t first[2];
  std::uint32_t count[2]; ///< items of a leaf; `inner`

  static constexpr std::uint32_t inner = 0xffffffff;
};

class Bvh {
public:
  Bvh() = default;
  /// @param boxes of that space
  /// @param leaf_size items below which a node is not split (but the first)
  Bvh(BvhSpace const& space, std::vector<BvhBox> boxes, std::uint32_t leaf_size = 2);

  BvhSpace const& space() const { return space_; }
  /// The first is the root.
  std::vector<BvhNode> const& nodes() const { return nodes_; }
  std::vector<std::uint32_t> const& items() const { return items_; }
  /// For those who put their things in this order, so that walks give places.
  std::vector<std::uint32_t> take_items() { return std::move(items_); }

private:
  BvhSpace space_;
  std::vector<BvhNode> nodes_;
  std::vector<std::uint32_t> items_;
};

/// Deepest tree that is built; below, items share a leaf.
inline constexpr int max_bvh_depth = 64;

/// Calls visit(item) for the items whose box the line meets in [from, to], roughly front to back;
/// `to` may shrink meanwhile. visit returns false to stop. Probe: BoxProbe or FanProbe, made for
/// the hierarchy's space.
template <class Probe, class Visit>
void walk(Bvh const& bvh, Probe const& probe, double from, double const& to, Visit&& visit) {
  struct Waiting {
    std::uint32_t first, count;
    double entry;
  };
  std::array<Waiting, max_bvh_depth + 2> stack;
  std::size_t waiting = 0;
  if (bvh.nodes().empty()) return;
  std::uint32_t const* const items = bvh.items().empty() ? nullptr : bvh.items().data();
  Waiting at{0, BvhNode::inner, from};
  for (;;) {
    if (at.count == BvhNode::inner) {
      BvhNode const& node = bvh.nodes()[at.first];
      double entry[2];
      unsigned const met = probe.enter(node, from, to, entry);
      if (met != 0) {
        // Of both the nearer, or the one that is met.
        unsigned const k = met == 3 ? (entry[0] <= entry[1] ? 0 : 1) : met - 1;
        if (met == 3) stack[waiting++] = {node.first[1 - k], node.count[1 - k], entry[1 - k]};
        at = {node.first[k], node.count[k], entry[k]};
        continue;
      }
    } else {
      for (std::uint32_t place = at.first; place < at.first + at.count; ++place) {
        if (!visit(items == nullptr ? place : items[place])) return;
      }
    }
    do {
      if (waiting == 0) return;
      at = stack[--waiting];
    } while (at.entry > to);
  }
}

} // namespace abbe::geometry
