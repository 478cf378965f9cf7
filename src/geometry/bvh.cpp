// SPDX-License-Identifier: MIT
#include "geometry/bvh.hpp"

#include "base/result.hpp"
#include "geometry/treelets.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace abbe::geometry {

namespace {

/// From so many items on, runs of neighbours are sorted out first.
constexpr std::uint32_t treelets_from = 1 << 14, treelet_size = 16;
constexpr std::size_t few_nodes = 1 << 12;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Deepest tree that is built; below, items share a leaf.
constexpr int deepest = deepest_bvh - 8;

/// Two boxes, and what is in each, as in BvhNode.
struct Pair {
  float planes[2][3][2];
  std::uint32_t first[2], count[2];
};

/// Four sides of a box at a time, said outright: compilers make single operations of plain loops.
using Four = float __attribute__((vector_size(16)));

Four load(float const* from) {
  Four out;
  std::memcpy(&out, from, sizeof out);
  return out;
}
using FourPlaces = std::int32_t __attribute__((vector_size(16)));
Four all_of(float x) {
  return Four{x, x, x, x};
}
void shrink(Four& a, Four const& b) {
  a = b < a ? b : a;
}
/// Sides 0 to 3 of a BvhBox, and 2 to 5: what they share is the same in both.
struct Sides {
  Four first, last;
  explicit Sides(BvhBox const& box) : first(load(box.side)), last(load(box.side + 2)) {}
  /// BvhBox::middle of each axis, and a number.
  Four middle() const { return first - Four{last[1], last[2], last[3], last[3]}; }
};

struct Box {
  Four first = all_of(std::numeric_limits<float>::infinity()), last = first; ///< as Sides
  void grow(Sides const& by) {
    shrink(first, by.first);
    shrink(last, by.last);
  }
  void grow(Box const& by) {
    shrink(first, by.first);
    shrink(last, by.last);
  }
  float side(int i) const { return i < 4 ? first[i] : last[i - 2]; }
  double area() const {
    double const x = extent(0), y = extent(1), z = extent(2);
    return x * y + y * z + z * x;
  }

private:
  double extent(int axis) const {
    double const wide = -static_cast<double>(side(axis + 3)) - static_cast<double>(side(axis));
    return wide > 0 ? wide : 0; // of no item: -infinity
  }
};

/// What is known of items before they are looked at one by one.
struct Extent {
  Box box;
  Four low = all_of(std::numeric_limits<float>::infinity()), high = -low; ///< of their middles
  void grow(BvhBox const& ref) {
    Sides const sides(ref);
    box.grow(sides);
    Four const middle = sides.middle();
    shrink(low, middle);
    high = middle > high ? middle : high;
  }
};

struct Builder {
  std::vector<BvhBox> refs; ///< parted in place: memory is read in a row
  std::uint32_t leaf_size;
  std::vector<Pair>& nodes;
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

  /// What stands in a node for a part of the items.
  struct Part {
    std::uint32_t first, count;
  };
  Part build(std::uint32_t begin, std::uint32_t end, int depth, Extent const& extent) {
    if (runs != nullptr && end - begin == 1) {
      Treelet const& run = (*runs)[refs[begin].item];
      return below->build(run.begin, run.end, depth, below->extent_of(run.begin, run.end));
    }
    Part const leaf{begin, end - begin};
    bool const root = nodes.empty();
    if (!root && end - begin <= leaf_size) return leaf;
    if (depth + 1 >= deepest && runs == nullptr) return leaf;
    Extent left, right;
    std::uint32_t const middle = split(begin, end, depth, extent, root, left, right);
    if (middle == begin) return leaf;
    auto const self = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    set(self, 0, left.box, build(begin, middle, depth + 1, left));
    set(self, 1, right.box, build(middle, end, depth + 1, right));
    return {self, BvhNode::inner};
  }
  void set(std::uint32_t number, std::size_t k, Box const& box, Part const& part) {
    Pair& node = nodes[number];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.planes[0][axis][k] = box.side(static_cast<int>(axis));
      node.planes[1][axis][k] = -box.side(static_cast<int>(axis) + 3);
    }
    node.first[k] = part.first;
    node.count[k] = part.count;
  }
  /// One item: the other box is empty.
  void build_single() {
    nodes.emplace_back();
    set(0, 0, extent_of(0, 1).box, {0, 1});
    set(0, 1, Box{}, {0, 0});
  }

  struct Plane {
    double cost = infinite;
    int axis = -1, bin = 0;
  };
  struct Bin {
    Box box;
    std::uint32_t count = 0;
  };

  /// Bins of the same width along each axis.
  struct Grid {
    Four low, per_extent;
    explicit Grid(Extent const& extent)
        : low(extent.low), per_extent(all_of(bins) / (extent.high - low)) {}
    /// Not where all centres are the same, or so near that the width of a bin has no inverse.
    bool usable(int axis) const {
      return per_extent[axis] < std::numeric_limits<float>::infinity();
    }
    /// Of the usable axes; else a number.
    FourPlaces operator()(Four const& middle) const {
      auto const place = __builtin_convertvector((middle - low) * per_extent, FourPlaces);
      FourPlaces const highest = {bins - 1, bins - 1, bins - 1, bins - 1};
      return place < highest ? place : highest;
    }
    int operator()(BvhBox const& ref, int axis) const {
      return std::min(bins - 1,
                      static_cast<int>((ref.middle(axis) - low[axis]) * per_extent[axis]));
    }
  };
  static int widest_axis(Extent const& extent) {
    Four const wide = extent.high - extent.low;
    return wide[0] >= wide[1] && wide[0] >= wide[2] ? 0 : (wide[1] >= wide[2] ? 1 : 2);
  }

  /// @param bin ascending in place; @param place their numbers: a plane lies behind each but the
  /// last of all
  static void better_plane(int axis, std::span<Bin const> bin, int const* place, Plane& best) {
    std::array<double, bins> right_cost{};
    Box grown;
    double number = 0;
    for (std::size_t b = bin.size() - 1; b > 0; --b) {
      grown.grow(bin[b].box);
      number += bin[b].count;
      right_cost[b] = number > 0 ? grown.area() * number : infinite;
    }
    grown = {};
    number = 0;
    for (std::size_t b = 0; b + 1 < bin.size(); ++b) {
      grown.grow(bin[b].box);
      number += bin[b].count;
      if (number == 0) continue;
      double const cost = grown.area() * number + right_cost[b + 1];
      if (cost < best.cost) best = {cost, axis, place[b]};
    }
  }

  Plane best_plane(std::uint32_t begin, std::uint32_t end, Extent const& extent) const {
    return end - begin <= few ? best_plane_of_few(begin, end, extent)
                              : best_plane_of_many(begin, end, extent);
  }

  Plane best_plane_of_many(std::uint32_t begin, std::uint32_t end, Extent const& extent) const {
    static constexpr int every[bins] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    Grid const grid(extent);
    std::array<std::array<Bin, bins>, 3> binned;
    bool const usable[3] = {grid.usable(0), grid.usable(1), grid.usable(2)};
    for (std::uint32_t i = begin; i < end; ++i) {
      Sides const sides(refs[i]);
      FourPlaces const at = grid(sides.middle());
      for (int axis = 0; axis < 3; ++axis) {
        if (!usable[axis]) continue;
        Bin& bin = binned[static_cast<std::size_t>(axis)][static_cast<std::size_t>(at[axis])];
        bin.box.grow(sides);
        ++bin.count;
      }
    }
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (usable[axis]) better_plane(axis, binned[static_cast<std::size_t>(axis)], every, best);
    }
    return best;
  }

  /// The same plane, unless it lies across an axis along which the items hardly spread.
  Plane best_plane_of_few(std::uint32_t begin, std::uint32_t end, Extent const& extent) const {
    Grid const grid(extent);
    std::uint32_t const count = end - begin;
    std::int32_t at[few][4];
    for (std::uint32_t i = 0; i < count; ++i) {
      FourPlaces const place = grid(Sides(refs[begin + i]).middle());
      std::memcpy(at[i], &place, sizeof place);
    }
    Four const wide = extent.high - extent.low;
    float const least = 0.25F * std::max(wide[0], std::max(wide[1], wide[2]));
    Plane best;
    std::array<Bin, few> binned;
    for (int axis = 0; axis < 3; ++axis) {
      if (!grid.usable(axis) || wide[axis] < least) continue;
      std::uint32_t filled = 0; // bins that have items, as bits
      for (std::uint32_t i = 0; i < count; ++i) filled |= 1U << at[i][axis];
      int place[bins];
      std::uint8_t rank[bins];
      std::size_t size = 0;
      for (; filled != 0; filled &= filled - 1) {
        int const b = std::countr_zero(filled);
        rank[b] = static_cast<std::uint8_t>(size);
        place[size] = b;
        binned[size++] = {};
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        Bin& bin = binned[rank[at[i][axis]]];
        bin.box.grow(Sides(refs[begin + i]));
        ++bin.count;
      }
      better_plane(axis, {binned.data(), size}, place, best);
    }
    return best;
  }

  /// As std::partition, with what is known of both parts.
  std::uint32_t part(std::uint32_t begin, std::uint32_t end, Plane const& plane,
                     Extent const& extent, Extent& left, Extent& right) {
    Grid const grid(extent);
    auto const is_left = [&](BvhBox const& ref) { return grid(ref, plane.axis) <= plane.bin; };
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

  /// @return where the items were parted; `begin` to keep them in one leaf, unless they `must` be
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, int depth, Extent const& extent,
                      bool must, Extent& left, Extent& right) {
    Plane const plane = best_plane(begin, end, extent);
    std::uint32_t const count = end - begin;
    double const area = extent.box.area();
    // A visit of a node costs about half of a test of an item.
    bool const worth = plane.axis >= 0 && plane.cost + 0.5 * area < area * count;
    if (!worth && !must && count <= 4 * leaf_size && runs == nullptr) return begin;
    if (plane.axis >= 0 && depth < deepest / 2) {
      std::uint32_t const at = part(begin, end, plane, extent, left, right);
      if (at != begin && at != end) return at;
    }
    // Equal centres, or a lopsided tree: halve by rank, so that the depth stays bounded.
    int const axis = widest_axis(extent);
    auto const first = refs.begin() + begin, middle = first + count / 2;
    std::nth_element(first, middle, refs.begin() + end, [&](BvhBox const& a, BvhBox const& b) {
      float const ca = a.middle(axis), cb = b.middle(axis);
      return ca != cb ? ca < cb : a.item < b.item;
    });
    left = extent_of(begin, begin + count / 2);
    right = extent_of(begin + count / 2, end);
    return begin + count / 2;
  }
};

/// Makes nodes of eight out of nodes of two.
struct Widener {
  std::vector<Pair> const& pairs;
  std::vector<BvhBox> const& refs;
  bool opens_leaves; ///< where there is room, items get boxes of their own
  std::vector<BvhNode>& nodes;

  struct Part {
    float planes[2][3];
    std::uint32_t first = 0, count = 0;
    float area() const {
      float const x = planes[1][0] - planes[0][0], y = planes[1][1] - planes[0][1],
                  z = planes[1][2] - planes[0][2];
      return x * y + y * z + z * x;
    }
  };
  struct Parts {
    std::array<Part, BvhNode::width> part;
    std::size_t size = 0;
  };

  void add(Pair const& pair, std::size_t k, Part& out) const {
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t axis = 0; axis < 3; ++axis)
        out.planes[side][axis] = pair.planes[side][axis][k];
    out.first = pair.first[k];
    out.count = pair.count[k];
  }
  void add_item(std::uint32_t place, Part& out) const {
    for (int axis = 0; axis < 3; ++axis) {
      out.planes[0][axis] = refs[place].side[axis];
      out.planes[1][axis] = -refs[place].side[axis + 3];
    }
    out.first = place;
    out.count = 1;
  }
  /// How many parts there are more when one is opened; 0: it stays.
  std::size_t more(Part const& part) const {
    if (part.count == BvhNode::inner) return 1;
    return opens_leaves && part.count > 1 ? part.count - 1 : 0;
  }
  void open(Parts& parts, std::size_t number) const {
    Part const from = parts.part[number];
    if (from.count == BvhNode::inner) {
      add(pairs[from.first], 0, parts.part[number]);
      add(pairs[from.first], 1, parts.part[parts.size++]);
      return;
    }
    add_item(from.first, parts.part[number]);
    for (std::uint32_t i = 1; i < from.count; ++i)
      add_item(from.first + i, parts.part[parts.size++]);
  }

  std::uint32_t build(std::uint32_t number) {
    Parts parts;
    for (std::size_t k = 0; k < 2; ++k)
      if (pairs[number].count[k] > 0) add(pairs[number], k, parts.part[parts.size++]);
    for (;;) {
      std::size_t largest = parts.size;
      for (std::size_t k = 0; k < parts.size; ++k) {
        std::size_t const by = more(parts.part[k]);
        if (by == 0 || parts.size + by > BvhNode::width) continue;
        if (largest == parts.size || parts.part[k].area() > parts.part[largest].area()) largest = k;
      }
      if (largest == parts.size) break;
      open(parts, largest);
    }
    auto const self = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    for (std::size_t k = 0; k < BvhNode::width; ++k) {
      bool const there = k < parts.size;
      Part const& part = parts.part[k];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr float far = std::numeric_limits<float>::infinity();
        nodes[self].planes[0][axis][k] = there ? part.planes[0][axis] : far;
        nodes[self].planes[1][axis][k] = there ? part.planes[1][axis] : -far;
      }
      bool const inner = there && part.count == BvhNode::inner;
      std::uint32_t const first = inner ? build(part.first) : there ? part.first : 0;
      nodes[self].first[k] = first;
      nodes[self].count[k] = there ? part.count : 0;
    }
    return self;
  }
};

} // namespace

Bvh::Bvh(BvhSpace const& space, std::vector<BvhBox> boxes, std::uint32_t leaf_size)
    : space_(space) {
  if (boxes.empty()) return;
  auto const count = static_cast<std::uint32_t>(boxes.size());
  std::uint32_t const in_leaf = std::max(2U, leaf_size);
  std::vector<Pair> pairs;
  pairs.reserve(count / (in_leaf / 2)); // as many as there are if leaves are half full
  std::vector<Treelet> runs;
  if (count >= treelets_from && count <= most_in_treelets)
    runs = make_treelets(boxes, treelet_size);
  Builder builder{std::move(boxes), in_leaf, pairs};
  if (count == 1) {
    builder.build_single();
  } else if (runs.empty()) {
    builder.build(0, count, 0, builder.extent_of(0, count));
  } else {
    Builder above{{}, 1, pairs, &runs, &builder};
    above.refs.reserve(runs.size());
    for (Treelet const& run : runs) {
      Box const box = builder.extent_of(run.begin, run.end).box;
      BvhBox ref;
      for (int i = 0; i < 6; ++i) ref.side[i] = box.side(i);
      ref.item = static_cast<std::uint32_t>(above.refs.size());
      above.refs.push_back(ref);
    }
    auto const number = static_cast<std::uint32_t>(runs.size());
    above.build(0, number, 0, above.extent_of(0, number));
  }
  nodes_.reserve(pairs.size() / 4 + 1);
  Widener{pairs, builder.refs, leaf_size == 1, nodes_}.build(0);
  items_.reserve(count);
  for (BvhBox const& box : builder.refs) items_.push_back(box.item);
  builder.refs = {};
  // In a large block, what was never touched takes no memory, and copying the rest does.
  if (nodes_.capacity() < few_nodes) nodes_.shrink_to_fit();
}

} // namespace abbe::geometry
