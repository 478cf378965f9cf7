// SPDX-License-Identifier: MIT
#include "geometry/treelets.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace abbe::geometry {

namespace {

constexpr int bits = 11;
constexpr double cells = 1 << bits;

/// Two zeros between the bits of a number below 2^11.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x00ff0000ff0000ff;
  x = (x | x << 8) & 0x300f00f00f00f00f;
  x = (x | x << 4) & 0x30c30c30c30c30c3;
  return (x | x << 2) & 0x9249249249249249;
}

/// Morton code, and below it the item's place.
using Key = std::uint64_t;
constexpr int place_bits = 31;
static_assert(3 * bits + place_bits <= 64 && most_in_treelets == 1U << place_bits);

std::uint32_t place_of(Key key) {
  return static_cast<std::uint32_t>(key % (Key{1} << place_bits));
}

struct Space {
  Vec3 low{std::numeric_limits<double>::infinity()}, high{-low}, scale{0};
  explicit Space(std::vector<BvhBox> const& boxes) {
    for (BvhBox const& box : boxes) {
      Vec3 const c(box.middle(0), box.middle(1), box.middle(2));
      low = glm::min(low, c);
      high = glm::max(high, c);
    }
    for (int i = 0; i < 3; ++i) {
      double const per_extent = cells / (high[i] - low[i]);
      scale[i] = per_extent < std::numeric_limits<double>::infinity() ? per_extent : 0;
    }
  }
  std::uint64_t code(BvhBox const& box) const {
    std::uint64_t code = 0;
    for (int i = 0; i < 3; ++i) {
      auto const cell =
          std::min(cells - 1, (static_cast<double>(box.middle(i)) - low[i]) * scale[i]);
      code |= spread(static_cast<std::uint64_t>(cell)) << i;
    }
    return code;
  }
};

/// By 11 bits at a time, from the lowest; stable.
void sort(std::vector<Key>& keys) {
  auto const digit = [](Key key, std::size_t k) {
    return static_cast<std::size_t>(key >> (place_bits + static_cast<int>(k) * bits)) % (1 << bits);
  };
  std::array<std::array<std::uint32_t, 1 << bits>, 3> start{};
  for (Key const key : keys) {
    for (std::size_t k = 0; k < 3; ++k) ++start[k][digit(key, k)];
  }
  std::vector<Key> other(keys.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t sum = 0;
    for (std::uint32_t& number : start[k]) sum += std::exchange(number, sum);
    for (Key const key : keys) other[start[k][digit(key, k)]++] = key;
    keys.swap(other);
  }
}

double half_area(BvhBox const& box) {
  auto const extent = [&box](int axis) {
    return -static_cast<double>(box.side[axis + 3]) - static_cast<double>(box.side[axis]);
  };
  Vec3 const d(extent(0), extent(1), extent(2));
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

class Cutter {
public:
  Cutter(std::vector<Key> const& keys, std::uint32_t largest) : keys_(keys), largest_(largest) {}
  /// Halves where the highest bit that differs does, down to runs that are short enough.
  void cut(std::uint32_t begin, std::uint32_t end) {
    if (end - begin <= largest_) {
      out.push_back({begin, end});
      return;
    }
    Key const differ = (keys_[begin] ^ keys_[end - 1]) >> place_bits << place_bits;
    std::uint32_t middle = begin + (end - begin) / 2;
    if (differ != 0) {
      Key const bit = std::bit_floor(differ);
      auto const first = keys_.begin() + begin;
      middle = begin
               + static_cast<std::uint32_t>(
                   std::partition_point(first, keys_.begin() + end,
                                        [bit](Key key) { return (key & bit) == 0; })
                   - first);
    }
    cut(begin, middle);
    cut(middle, end);
  }
  std::vector<Treelet> out;

private:
  std::vector<Key> const& keys_;
  std::uint32_t largest_;
};

} // namespace

std::vector<Treelet> make_treelets(std::vector<BvhBox>& boxes, std::uint32_t largest) {
  Space const space(boxes);
  // Such that items of a surface of like parts are far below: runs of them reach over more.
  double area = 0;
  for (BvhBox const& box : boxes) area += half_area(box);
  double const alone = 16 * area / static_cast<double>(boxes.size());
  std::vector<Key> keys;
  keys.reserve(boxes.size());
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (half_area(boxes[i]) > alone)
      large.push_back(i);
    else
      keys.push_back(space.code(boxes[i]) << place_bits | i);
  }
  sort(keys);
  Cutter cutter(keys, largest);
  if (!keys.empty()) cutter.cut(0, static_cast<std::uint32_t>(keys.size()));
  for (std::uint32_t const place : large) {
    auto const at = static_cast<std::uint32_t>(keys.size());
    cutter.out.push_back({at, at + 1});
    keys.push_back(place);
  }
  // In place, one cycle of the permutation after the other, it would take four times as long: each
  // look waits for the one before.
  std::vector<BvhBox> sorted;
  sorted.reserve(boxes.size());
  for (Key const key : keys) sorted.push_back(boxes[place_of(key)]);
  boxes = std::move(sorted);
  return std::move(cutter.out);
}

} // namespace abbe::geometry
