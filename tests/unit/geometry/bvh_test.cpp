// SPDX-License-Identifier: MIT
#include "geometry/bvh_walk.hpp"
#include "geometry/fan_probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace abbe::geometry {
namespace {

class Numbers {
public:
  explicit Numbers(unsigned seed) : numbers_(seed) {}
  double share() { return static_cast<double>(numbers_()) / 0x1p32; }
  double between(double low, double high) { return low + share() * (high - low); }
  /// Any sign, any size from 2^low to 2^high.
  double any(double low, double high) {
    return (share() < 0.5 ? -1 : 1) * std::exp2(between(low, high));
  }
  Vec3 any_vector(double low, double high) {
    return {any(low, high), any(low, high), any(low, high)};
  }

private:
  std::mt19937 numbers_;
};

BvhSpace space_of(std::vector<Bounds> const& boxes) {
  BvhSpaceFinder finder;
  for (Bounds const& box : boxes) finder.add(box.low, box.high);
  return finder.space();
}
Bvh bvh_of(std::vector<Bounds> const& boxes, std::uint32_t leaf_size = 1) {
  BvhSpace const space = space_of(boxes);
  std::vector<BvhBox> small;
  for (Bounds const& box : boxes)
    small.push_back(space.box(box.low, box.high, static_cast<std::uint32_t>(small.size())));
  return Bvh(space, small, leaf_size);
}

std::vector<Bounds> gravel(std::uint32_t count, double scale) {
  Numbers numbers(1);
  std::vector<Bounds> boxes;
  for (std::uint32_t i = 0; i < count; ++i) {
    Vec3 const low(numbers.share(), numbers.share(), numbers.share() * 0.1);
    double const size = i % 1000 == 0 ? 0.5 : 0.01; // walls among gravel
    Vec3 const extent(numbers.share(), numbers.share(), numbers.share());
    boxes.push_back({scale * low, scale * (low + extent * size), false});
  }
  return boxes;
}

/// A plane of a float box in the world, to 2^-64 of its size.
using Exact = long double;
Exact in_world(BvhSpace const& space, int axis, float plane) {
  return Exact(space.centre[axis]) + Exact(space.unit) * Exact(plane);
}

/// Every item is once in a leaf, and each box on the way to it contains its own.
class Sound {
public:
  Sound(Bvh const& bvh, std::vector<Bounds> const& boxes)
      : bvh_(bvh), boxes_(boxes), seen_(boxes.size(), 0) {
    look(0, {});
    EXPECT_TRUE(std::all_of(seen_.begin(), seen_.end(), [](int times) { return times == 1; }));
  }

private:
  using Way = std::vector<std::pair<BvhNode const*, std::size_t>>;
  void look(std::uint32_t number, Way const& way) {
    BvhNode const& node = bvh_.nodes()[number];
    for (std::size_t k = 0; k < BvhNode::width; ++k) {
      Way on = way;
      on.push_back({&node, k});
      if (node.count[k] == BvhNode::inner) {
        look(node.first[k], on);
        continue;
      }
      for (std::uint32_t i = 0; i < node.count[k]; ++i) {
        std::uint32_t const item = bvh_.items()[node.first[k] + i];
        ++seen_[item];
        for (auto const& [above, side] : on) expect_inside(*above, side, boxes_[item]);
      }
    }
  }
  void expect_inside(BvhNode const& node, std::size_t k, Bounds const& box) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      int const i = static_cast<int>(axis);
      ASSERT_LE(in_world(bvh_.space(), i, node.planes[0][axis][k]), Exact(box.low[i]));
      ASSERT_GE(in_world(bvh_.space(), i, node.planes[1][axis][k]), Exact(box.high[i]));
    }
  }
  Bvh const& bvh_;
  std::vector<Bounds> const& boxes_;
  std::vector<int> seen_;
};

TEST(Bvh, HoldsEachItemOnceInBoxesThatContainIt) {
  for (std::uint32_t const count : {1U, 2U, 3U, 17U, 1000U, 40000U}) {
    auto const boxes = gravel(count, 1);
    Sound(bvh_of(boxes), boxes);
    Sound(bvh_of(boxes, 4), boxes);
  }
}

TEST(Bvh, HoldsAManyEqualBoxesAndAsManyInARow) {
  std::vector<Bounds> equal, row;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    equal.push_back({Vec3(1), Vec3(2), false});
    row.push_back({Vec3(i, 0, 0), Vec3(i + 1.0, 1, 1), false});
  }
  Sound(bvh_of(equal), equal);
  Sound(bvh_of(row), row);
}

/// What a line may meet is what a look at each box finds, in items many enough for runs of
/// neighbours.
TEST(Bvh, WalkFindsWhatALookAtEachBoxFinds) {
  auto const boxes = gravel(20000, 1);
  Bvh const bvh = bvh_of(boxes);
  Numbers numbers(2);
  for (int k = 0; k < 50; ++k) {
    Ray ray;
    ray.origin = {numbers.share(), numbers.share(), -1};
    ray.direction = {numbers.share() - 0.5, numbers.share() - 0.5, 1};
    BoxProbe const probe(ray);
    std::set<std::uint32_t> found, expected;
    double const to = 1e9;
    double entry = 0;
    // Leaves hold few items, all of which are visited with one of them.
    walk(bvh, NodeProbe(ray, bvh.space()), 0.0, to, [&](std::uint32_t item) {
      if (probe.enter(boxes[item].low, boxes[item].high, 0.0, to, entry)) found.insert(item);
      return true;
    });
    for (std::uint32_t item = 0; item < boxes.size(); ++item) {
      if (probe.enter(boxes[item].low, boxes[item].high, 0.0, to, entry)) expected.insert(item);
    }
    EXPECT_EQ(found, expected);
  }
}

/// Scaling by a power of two gives the same tree.
TEST(Bvh, DoesNotDependOnTheScale) {
  Bvh const one = bvh_of(gravel(20000, 1));
  for (double const scale : {0x1p40, 0x1p-60, 0x1p900, 0x1p-900}) {
    Bvh const other = bvh_of(gravel(20000, scale));
    ASSERT_EQ(one.items(), other.items());
    ASSERT_EQ(one.nodes().size(), other.nodes().size());
  }
}

/// A few boxes about a place, of any size and place in the range of doubles.
std::vector<Bounds> boxes_anywhere(Numbers& numbers, double& size) {
  size = std::exp2(numbers.between(-1040, 1000));
  Vec3 const place = numbers.share() < 0.3 ? Vec3(0) : size * numbers.any_vector(-4, 22);
  std::vector<Bounds> boxes;
  for (int i = 0; i < 6; ++i) {
    Vec3 const low = place + size * numbers.any_vector(-30, 0);
    Vec3 extent = size * glm::abs(numbers.any_vector(-40, 0));
    if (numbers.share() < 0.2) extent[i % 3] = 0;
    boxes.push_back({low, low + extent, false});
  }
  return boxes;
}

TEST(Bvh, FloatsContainTheBoxesAtAnyScaleAndPlace) {
  Numbers numbers(3);
  for (int k = 0; k < 20000; ++k) {
    double size = 0;
    auto const boxes = boxes_anywhere(numbers, size);
    Bvh const bvh = bvh_of(boxes);
    Sound(bvh, boxes);
  }
}

/// A box at a distance d from the space's centre is wider by less than 2^-21 d: walks stay cheap,
/// at any scale.
TEST(Bvh, FloatsAreNotMuchWider) {
  for (double const scale : {1.0, 1e-300, 1e300, 1e-12}) {
    auto const boxes = gravel(100, scale);
    BvhSpace const space = space_of(boxes);
    for (Bounds const& box : boxes) {
      BvhBox const small = space.box(box.low, box.high, 0);
      for (int axis = 0; axis < 3; ++axis) {
        Exact const low = in_world(space, axis, small.side[axis]);
        Exact const high = in_world(space, axis, -small.side[axis + 3]);
        EXPECT_LE((Exact(box.low[axis]) - low) / Exact(scale), 0x1p-21L);
        EXPECT_LE((high - Exact(box.high[axis])) / Exact(scale), 0x1p-21L);
      }
    }
  }
}

/// Near small things among large ones, floats count from the small ones.
TEST(Bvh, FloatsCountFromTheSmallBoxes) {
  std::vector<Bounds> boxes{{Vec3(-1e7, -2e7, -1e7), Vec3(1e7, 0, 1e7), false}};
  Numbers numbers(4);
  for (int i = 0; i < 1000; ++i) {
    Vec3 const low(numbers.share(), numbers.share(), numbers.share());
    boxes.push_back({low, low + 0.001, false});
  }
  BvhSpace const space = space_of(boxes);
  BvhBox const pebble = space.box(boxes[1].low, boxes[1].high, 1);
  double const wide = (-pebble.side[3] - pebble.side[0]) * space.unit;
  EXPECT_NEAR(wide, 0.001, 1e-5); // a float about the middle of the planet would have steps of 1
}

/// Lines through points of the boxes, at any scale, from near and far, along axes too: a line that
/// passes within a box by the test in doubles gets to its item, alone and in a fan.
TEST(Bvh, WalkLeavesOutNothingThatDoublesAccept) {
  Numbers numbers(5);
  int accepted = 0;
  for (int k = 0; k < 20000; ++k) {
    double size = 0;
    auto const boxes = boxes_anywhere(numbers, size);
    Bvh const bvh = bvh_of(boxes);
    Bounds const& goal = boxes[static_cast<std::size_t>(k) % boxes.size()];
    Vec3 const share(numbers.share(), numbers.share(), numbers.share() < 0.5 ? 0 : 1);
    Ray ray;
    ray.direction = numbers.any_vector(-30, 0);
    if (numbers.share() < 0.3) ray.direction[k % 3] = 0;
    ray.origin = goal.low + share * (goal.high - goal.low)
                 - size * std::exp2(numbers.between(-60, 20)) * ray.direction;
    BoxProbe const probe(ray);
    FanExtents extents;
    for (int i = 0; i < 3; ++i) {
      extents.origin[i] = {ray.origin[i], ray.origin[i]};
      extents.direction[i] = {ray.direction[i], ray.direction[i]};
    }
    double const to = std::numeric_limits<double>::infinity();
    std::set<std::uint32_t> alone, fan;
    auto const into = [](std::set<std::uint32_t>& set) {
      return [&set](std::uint32_t item) { return set.insert(item).second; };
    };
    walk(bvh, NodeProbe(ray, bvh.space()), 0.0, to, into(alone));
    walk(bvh, FanNodeProbe(extents, bvh.space()), 0.0, to, into(fan));
    for (std::uint32_t item = 0; item < boxes.size(); ++item) {
      double entry = 0;
      if (!probe.enter(boxes[item].low, boxes[item].high, 0.0, to, entry)) continue;
      ++accepted;
      ASSERT_TRUE(alone.contains(item)) << k;
      ASSERT_TRUE(fan.contains(item)) << k;
    }
  }
  EXPECT_GT(accepted, 10000);
}

} // namespace
} // namespace abbe::geometry
