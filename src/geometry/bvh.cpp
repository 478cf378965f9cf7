// SPDX-License-Identifier: MIT
#include "geometry/bvh.hpp"

#include "base/result.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace abbe::geometry {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Box {
  Vec3 low{infinite}, high{-infinite};
  void grow(Vec3 const& from, Vec3 const& to) {
    low = glm::min(low, from);
    high = glm::max(high, to);
  }
  double area() const {
    Vec3 const d = glm::max(high - low, Vec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

struct Builder {
  std::vector<BvhBox> refs; ///< parted in place: memory is read in a row
  std::uint32_t leaf_size;
  std::vector<BvhNode>& nodes;

  static constexpr int bins = 16;

  void build(std::uint32_t begin, std::uint32_t end, int depth) {
    Box box, centres;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.grow(refs[i].low, refs[i].high);
      Vec3 const c = refs[i].centre();
      centres.grow(c, c);
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
  struct Bin {
    Box box;
    std::uint32_t count = 0;
  };
  using Bins = std::array<Bin, bins>;

  static int bin_of(double centre, double low, double extent) {
    return std::min(bins - 1, static_cast<int>((centre - low) / extent * bins));
  }

  static void better_plane(int axis, Bins const& bin, Plane& best) {
    std::array<double, bins> right_cost{};
    Box grown;
    double number = 0;
    for (std::size_t b = bins - 1; b > 0; --b) {
      grown.grow(bin[b].box.low, bin[b].box.high);
      number += bin[b].count;
      right_cost[b] = number > 0 ? grown.area() * number : infinite;
    }
    grown = {};
    number = 0;
    for (std::size_t b = 0; b + 1 < bins; ++b) {
      grown.grow(bin[b].box.low, bin[b].box.high);
      number += bin[b].count;
      if (number == 0) continue;
      double const cost = grown.area() * number + right_cost[b + 1];
      if (cost < best.cost) best = {cost, axis, static_cast<int>(b)};
    }
  }

  Plane best_plane(std::uint32_t begin, std::uint32_t end, Box const& centres) const {
    std::array<Bins, 3> binned;
    Vec3 const extent = centres.high - centres.low;
    for (std::uint32_t i = begin; i < end; ++i) {
      BvhBox const& ref = refs[i];
      Vec3 const c = ref.centre();
      for (int axis = 0; axis < 3; ++axis) {
        if (!(extent[axis] > 0)) continue;
        int const at = bin_of(c[axis], centres.low[axis], extent[axis]);
        Bin& bin = binned[static_cast<std::size_t>(axis)][static_cast<std::size_t>(at)];
        bin.box.grow(ref.low, ref.high);
        ++bin.count;
      }
    }
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (extent[axis] > 0) better_plane(axis, binned[static_cast<std::size_t>(axis)], best);
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
    auto const first = refs.begin() + begin, last = refs.begin() + end;
    Vec3 const extent = centres.high - centres.low;
    if (plane.axis >= 0 && depth < max_bvh_depth / 2) {
      double const low = centres.low[plane.axis], width = extent[plane.axis];
      auto const middle = std::partition(first, last, [&](BvhBox const& ref) {
        return bin_of(ref.centre()[plane.axis], low, width) <= plane.bin;
      });
      auto const at = static_cast<std::uint32_t>(middle - refs.begin());
      if (at != begin && at != end) return at;
    }
    // Equal centres, or a lopsided tree: halve by rank, so that the depth stays bounded.
    int const axis =
        extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    auto const middle = first + count / 2;
    std::nth_element(first, middle, last, [&](BvhBox const& a, BvhBox const& b) {
      double const ca = a.centre()[axis], cb = b.centre()[axis];
      return ca != cb ? ca < cb : a.item < b.item;
    });
    return begin + count / 2;
  }
};

} // namespace

Bvh::Bvh(std::vector<BvhBox> boxes, std::uint32_t leaf_size) {
  if (boxes.empty()) return;
  auto const count = static_cast<std::uint32_t>(boxes.size());
  Builder builder{std::move(boxes), leaf_size, nodes_};
  nodes_.reserve(2 * (count / std::max(leaf_size, 1U)) + 1);
  builder.build(0, count, 0);
  items_.reserve(count);
  for (BvhBox const& box : builder.refs) items_.push_back(box.item);
}

} // namespace abbe::geometry
