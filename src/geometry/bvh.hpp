// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh_space.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Bounding volume hierarchy over boxes, eight to a node: a tree of twos, built top-down by binned
/// surface area heuristic, whose largest boxes are opened until a node has eight. The build depends
/// on the boxes alone: the same tree on every machine and run. Rays walk it by bvh_walk.hpp.
namespace abbe::geometry {

/// Eight boxes side by side, and what is in each: one look for all of them.
struct alignas(64) BvhNode {
  static constexpr std::size_t width = 8;
  /// Low corners, then high ones; by axis; of each box.
  float planes[2][3][width];
  /// Of a leaf the first place in items; else the node.
  std::uint32_t first[width];
  std::uint32_t count[width]; ///< items of a leaf; `inner`; 0: no box

  static constexpr std::uint32_t inner = 0xffffffff;
};

/// More nodes on top of one another than there are: items share a leaf below.
inline constexpr std::size_t deepest_bvh = 72;

class Bvh {
public:
  Bvh() = default;
  /// @param boxes of that space
  /// @param leaf_size items that share a box; 1: most have one of their own
  Bvh(BvhSpace const& space, std::vector<BvhBox> boxes, std::uint32_t leaf_size = 1);

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

/// visit(item) of each whose box meets a box of the same space, some perhaps that do not.
template <class Visit>
void each_meeting(Bvh const& bvh, BvhBox const& box, Visit const& visit) {
  if (bvh.nodes().empty()) return;
  std::uint32_t waiting[BvhNode::width * deepest_bvh];
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    BvhNode const& node = bvh.nodes()[waiting[--count]];
    std::uint32_t apart[BvhNode::width] = {};
    for (int axis = 0; axis < 3; ++axis) {
      float const low = box.side[axis], high = -box.side[axis + 3];
      for (std::size_t k = 0; k < BvhNode::width; ++k)
        apart[k] |= static_cast<std::uint32_t>(!(node.planes[0][axis][k] <= high))
                    | static_cast<std::uint32_t>(!(low <= node.planes[1][axis][k]));
    }
    for (std::size_t k = 0; k < BvhNode::width; ++k) {
      if (apart[k] != 0 || node.count[k] == 0) continue;
      if (node.count[k] == BvhNode::inner) {
        waiting[count++] = node.first[k];
        continue;
      }
      for (std::uint32_t i = 0; i < node.count[k]; ++i) visit(bvh.items()[node.first[k] + i]);
    }
  }
}

} // namespace abbe::geometry
