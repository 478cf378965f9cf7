// SPDX-License-Identifier: MIT
#include "geometry/bvh.hpp"

#include "base/result.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace abbe::geometry {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Box {
  Vec3 low{infinite}, high{-infinite};
  void grow(Bounds const& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  void grow(Box const& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  double area() const {
    Vec3 const d = glm::max(high - low, Vec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

struct Builder {
  std::span<Bounds const> boxes;
  std::uint32_t leaf_size;
  std::vector<BvhNode>& nodes;
  std::vector<std::uint32_t>& items;

  static constexpr int bins = 16;

  Vec3 centre(std::uint32_t item) const { return boxes[item].low * 0.5 + boxes[item].high * 0.5; }

  void build(std::uint32_t begin, std::uint32_t end, int depth) {
    Box box, centres;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.grow(boxes[items[i]]);
      Vec3 const c = centre(items[i]);
      centres.grow(Bounds{c, c, false});
    }
    std::size_t const self = nodes.size();
    nodes.push_back({box.low, box.high, begin, end - begin});
    if (end - begin <= leaf_size || depth + 1 >= max_bvh_depth) return;
    std::uint32_t const middle = split(begin, end, box, centres, depth);
    if (middle == begin) return;
    nodes[self].count = 0;
    build(begin, middle, depth + 1);
    nodes[self].first = static_cast<std::uint32_t>(nodes.size());
    build(middle, end, depth + 1);
  }

  struct Plane {
    double cost = infinite;
    int axis = -1, bin = 0;
  };

  int bin_of(std::uint32_t item, int axis, Box const& centres) const {
    double const extent = centres.high[axis] - centres.low[axis];
    double const at = (centre(item)[axis] - centres.low[axis]) / extent * bins;
    return std::min(bins - 1, static_cast<int>(at));
  }

  Plane best_plane(std::uint32_t begin, std::uint32_t end, Box const& centres) const {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centres.high[axis] > centres.low[axis])) continue;
      std::array<Box, bins> box;
      std::array<std::uint32_t, bins> count{};
      for (std::uint32_t i = begin; i < end; ++i) {
        auto const bin = static_cast<std::size_t>(bin_of(items[i], axis, centres));
        box[bin].grow(boxes[items[i]]);
        ++count[bin];
      }
      std::array<double, bins> right_cost{};
      Box grown;
      double number = 0;
      for (int b = bins - 1; b > 0; --b) {
        auto const bin = static_cast<std::size_t>(b);
        grown.grow(box[bin]);
        number += count[bin];
        right_cost[bin] = number > 0 ? grown.area() * number : infinite;
      }
      grown = {};
      number = 0;
      for (int b = 0; b + 1 < bins; ++b) {
        auto const bin = static_cast<std::size_t>(b);
        grown.grow(box[bin]);
        number += count[bin];
        if (number == 0) continue;
        double const cost = grown.area() * number + right_cost[bin + 1];
        if (cost < best.cost) best = {cost, axis, b};
      }
    }
    return best;
  }

  /// @return where the items were parted; `begin` to keep them in one leaf
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, Box const& box, Box const& centres,
                      int depth) {
    Plane const plane = best_plane(begin, end, centres);
    std::uint32_t const count = end - begin;
    // A visit of a node costs about half of a test of an item.
    bool const worth = plane.axis >= 0 && plane.cost + 0.5 * box.area() < box.area() * count;
    if (!worth && count <= 4 * leaf_size) return begin;
    auto const first = items.begin() + begin, last = items.begin() + end;
    if (plane.axis >= 0 && depth < max_bvh_depth / 2) {
      auto const middle = std::partition(first, last, [&](std::uint32_t item) {
        return bin_of(item, plane.axis, centres) <= plane.bin;
      });
      auto const at = static_cast<std::uint32_t>(middle - items.begin());
      if (at != begin && at != end) return at;
    }
    // Equal centres, or a lopsided tree: halve by rank, so that the depth stays bounded.
    Vec3 const extent = centres.high - centres.low;
    int const axis =
        extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    auto const middle = first + count / 2;
    std::nth_element(first, middle, last, [&](std::uint32_t a, std::uint32_t b) {
      double const ca = centre(a)[axis], cb = centre(b)[axis];
      return ca != cb ? ca < cb : a < b;
    });
    return begin + count / 2;
  }
};

} // namespace

Bvh::Bvh(std::span<Bounds const> boxes, std::uint32_t leaf_size) {
  if (boxes.empty()) return;
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0U);
  nodes_.reserve(boxes.size() * 2 / std::max(leaf_size, 1U));
  Builder{boxes, leaf_size, nodes_, items_}.build(0, static_cast<std::uint32_t>(boxes.size()), 0);
}

} // namespace abbe::geometry
