// SPDX-License-Identifier: MIT
#include "geometry/bvh.hpp"

#include "base/result.hpp"
#include "geometry/treelets.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace abbe::geometry {

namespace {

/// From so many items on, runs of neighbours are sorted out first.
constexpr std::uint32_t treelets_from = 1 << 14, treelet_size = 16;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Box {
  double side[6] = {infinite, infinite, infinite, infinite, infinite, infinite}; ///< as BvhBox
  void grow(double const (&by)[6]) {
    // Two at a time, said outright: compilers make single operations of the plain loop.
    using Pair = double __attribute__((vector_size(16)));
    for (int i = 0; i < 6; i += 2) {
      Pair ours, theirs;
      std::memcpy(&ours, side + i, sizeof ours);
      std::memcpy(&theirs, by + i, sizeof theirs);
      ours = theirs < ours ? theirs : ours;
      std::memcpy(side + i, &ours, sizeof ours);
    }
  }
  void grow(Vec3 const& point) { grow({point.x, point.y, point.z, -point.x, -point.y, -point.z}); }
  Vec3 low() const { return {side[0], side[1], side[2]}; }
  Vec3 high() const { return {-side[3], -side[4], -side[5]}; }
  Vec3 extent() const { return high() - low(); }
  double area() const {
    Vec3 const d = glm::max(extent(), Vec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

/// What is known of items before they are looked at one by one.
struct Extent {
  Box box, centres;
  void grow(BvhBox const& ref) {
    box.grow(ref.side);
    centres.grow(ref.centre());
  }
};

struct Builder {
  std::vector<BvhBox> refs; ///< parted in place: memory is read in a row
  std::uint32_t leaf_size;
  std::vector<BvhNode>& nodes;
  /// Where `refs` are boxes of runs of another builder's items: that goes on where one is left.
  std::vector<Treelet> const* runs = nullptr;
  Builder* below = nullptr;

  static constexpr int bins = 16;
  /// Up to so many items, only the bins that have some are looked at.
  static constexpr std::uint32_t few = 16;

  Extent extent_of(std::uint32_t begin, std::uint32_t end) const {
    Extent extent;
    for (std::uint32_t i = begin; i < end; ++i) extent.grow(refs[i]);
    return extent;
  }

  void build(std::uint32_t begin, std::uint32_t end, int depth, Extent const& extent) {
    if (runs != nullptr && end - begin == 1) {
      Treelet const& run = (*runs)[refs[begin].item];
      return below->build(run.begin, run.end, depth, below->extent_of(run.begin, run.end));
    }
    std::size_t const self = nodes.size();
    nodes.push_back({extent.box.low(), extent.box.high(), begin, end - begin});
    if (end - begin <= leaf_size || (depth + 1 >= max_bvh_depth && runs == nullptr)) return;
    Extent left, right;
    std::uint32_t const middle = split(begin, end, depth, extent, left, right);
    if (middle == begin) return;
    nodes[self].count = 0;
    build(begin, middle, depth + 1, left);
    nodes[self].first = static_cast<std::uint32_t>(nodes.size());
    build(middle, end, depth + 1, right);
  }

  struct Plane {
    double cost = infinite;
    int axis = -1, bin = 0;
  };
  struct Bin {
    Box box;
    std::uint32_t count = 0;
  };

  /// Bins of the same width along an axis.
  struct Grid {
    int axis;
    double low, per_extent;
    Grid(Box const& centres, int along)
        : axis(along), low(centres.low()[along]), per_extent(bins / centres.extent()[along]) {}
    /// Not where all centres are the same, or so near that the width of a bin has no inverse.
    bool usable() const { return per_extent < infinite; }
    int operator()(BvhBox const& ref) const {
      return std::min(bins - 1, static_cast<int>((ref.centre(axis) - low) * per_extent));
    }
  };
  static int widest_axis(Box const& centres) {
    Vec3 const wide = centres.extent();
    return wide.x >= wide.y && wide.x >= wide.z ? 0 : (wide.y >= wide.z ? 1 : 2);
  }

  /// @param bin ascending in place; @param place their numbers: a plane lies behind each but the
  /// last of all
  static void better_plane(int axis, std::span<Bin const> bin, int const* place, Plane& best) {
    std::array<double, bins> right_cost{};
    Box grown;
    double number = 0;
    for (std::size_t b = bin.size() - 1; b > 0; --b) {
      grown.grow(bin[b].box.side);
      number += bin[b].count;
      right_cost[b] = number > 0 ? grown.area() * number : infinite;
    }
    grown = {};
    number = 0;
    for (std::size_t b = 0; b + 1 < bin.size(); ++b) {
      grown.grow(bin[b].box.side);
      number += bin[b].count;
      if (number == 0) continue;
      double const cost = grown.area() * number + right_cost[b + 1];
      if (cost < best.cost) best = {cost, axis, place[b]};
    }
  }

  Plane best_plane(std::uint32_t begin, std::uint32_t end, Box const& centres) const {
    return end - begin <= few ? best_plane_of_few(begin, end, centres)
                              : best_plane_of_many(begin, end, centres);
  }

  Plane best_plane_of_many(std::uint32_t begin, std::uint32_t end, Box const& centres) const {
    static constexpr int every[bins] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      Grid const grid(centres, axis);
      if (!grid.usable()) continue;
      std::array<Bin, bins> binned;
      for (std::uint32_t i = begin; i < end; ++i) {
        Bin& bin = binned[static_cast<std::size_t>(grid(refs[i]))];
        bin.box.grow(refs[i].side);
        ++bin.count;
      }
      better_plane(axis, binned, every, best);
    }
    return best;
  }

  /// The same plane.
  Plane best_plane_of_few(std::uint32_t begin, std::uint32_t end, Box const& centres) const {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      Grid const grid(centres, axis);
      if (!grid.usable()) continue;
      std::array<int, few> at{};
      std::uint32_t filled = 0; // bins that have items, as bits
      for (std::uint32_t i = begin; i < end; ++i) filled |= 1U << (at[i - begin] = grid(refs[i]));
      std::array<int, bins> place{};
      std::array<std::size_t, bins> rank{};
      std::size_t size = 0;
      for (std::size_t b = 0; b < bins; ++b) {
        rank[b] = size;
        place[size] = static_cast<int>(b);
        size += (filled >> b) & 1U; // at most b + 1
      }
      std::array<Bin, few> binned;
      for (std::uint32_t i = begin; i < end; ++i) {
        Bin& bin = binned[rank[static_cast<std::size_t>(at[i - begin])]];
        bin.box.grow(refs[i].side);
        ++bin.count;
      }
      better_plane(axis, {binned.data(), size}, place.data(), best);
    }
    return best;
  }

  /// As std::partition, with what is known of both parts.
  std::uint32_t part(std::uint32_t begin, std::uint32_t end, Plane const& plane, Box const& centres,
                     Extent& left, Extent& right) {
    Grid const grid(centres, plane.axis);
    auto const is_left = [&](BvhBox const& ref) { return grid(ref) <= plane.bin; };
    std::uint32_t from = begin, to = end;
    for (;; ++from) {
      for (; from != to && is_left(refs[from]); ++from) left.grow(refs[from]);
      if (from == to) return from;
      for (--to; from != to && !is_left(refs[to]); --to) right.grow(refs[to]);
      right.grow(refs[from]); // a right one either way
      if (from == to) return from;
      std::swap(refs[from], refs[to]);
      left.grow(refs[from]);
    }
  }

  /// @return where the items were parted; `begin` to keep them in one leaf
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, int depth, Extent const& extent,
                      Extent& left, Extent& right) {
    Plane const plane = best_plane(begin, end, extent.centres);
    std::uint32_t const count = end - begin;
    double const area = extent.box.area();
    // A visit of a node costs about half of a test of an item.
    bool const worth = plane.axis >= 0 && plane.cost + 0.5 * area < area * count;
    if (!worth && count <= 4 * leaf_size && runs == nullptr) return begin;
    if (plane.axis >= 0 && depth < max_bvh_depth / 2) {
      std::uint32_t const at = part(begin, end, plane, extent.centres, left, right);
      if (at != begin && at != end) return at;
    }
    // Equal centres, or a lopsided tree: halve by rank, so that the depth stays bounded.
    int const axis = widest_axis(extent.centres);
    auto const first = refs.begin() + begin, middle = first + count / 2;
    std::nth_element(first, middle, refs.begin() + end, [&](BvhBox const& a, BvhBox const& b) {
      double const ca = a.centre(axis), cb = b.centre(axis);
      return ca != cb ? ca < cb : a.item < b.item;
    });
    left = extent_of(begin, begin + count / 2);
    right = extent_of(begin + count / 2, end);
    return begin + count / 2;
  }
};

} // namespace

Bvh::Bvh(std::vector<BvhBox> boxes, std::uint32_t leaf_size) {
  if (boxes.empty()) return;
  auto const count = static_cast<std::uint32_t>(boxes.size());
  nodes_.reserve(2 * (count / std::max(leaf_size, 1U)) + 1);
  std::vector<Treelet> runs;
  if (count >= treelets_from) runs = make_treelets(boxes, treelet_size);
  Builder builder{std::move(boxes), leaf_size, nodes_};
  if (runs.empty()) {
    builder.build(0, count, 0, builder.extent_of(0, count));
  } else {
    Builder above{{}, 1, nodes_, &runs, &builder};
    above.refs.reserve(runs.size());
    for (Treelet const& run : runs) {
      Box const box = builder.extent_of(run.begin, run.end).box;
      above.refs.emplace_back(box.low(), box.high(), static_cast<std::uint32_t>(above.refs.size()));
    }
    auto const number = static_cast<std::uint32_t>(runs.size());
    above.build(0, number, 0, above.extent_of(0, number));
  }
  items_.reserve(count);
  for (BvhBox const& box : builder.refs) items_.push_back(box.item);
}

} // namespace abbe::geometry
