// SPDX-License-Identifier: MIT
#include "geometry/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace abbe::geometry {
namespace {

std::vector<BvhBox> gravel(std::uint32_t count, double scale) {
  std::mt19937 numbers(1);
  auto const share = [&] { return static_cast<double>(numbers()) / 0x1p32; };
  std::vector<BvhBox> boxes;
  for (std::uint32_t i = 0; i < count; ++i) {
    Vec3 const low(share(), share(), share() * 0.1);
    double const size = i % 1000 == 0 ? 0.5 : 0.01; // walls among gravel
    boxes.emplace_back(scale * low, scale * (low + Vec3(share(), share(), share()) * size), i);
  }
  return boxes;
}

/// Every box lies in its leaf's, every child in its parent: the lowest corner is the parent's.
void expect_sound(Bvh const& bvh, std::vector<BvhBox> const& boxes) {
  std::vector<int> seen(boxes.size(), 0);
  for (BvhNode const& node : bvh.nodes()) {
    for (std::uint32_t i = 0; i < node.count; ++i) {
      BvhBox const& box = boxes[bvh.items()[node.first + i]];
      ++seen[box.item];
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(node.low[k], box.side[k]);
        EXPECT_GE(node.high[k], -box.side[k + 3]);
      }
    }
    if (node.count > 0) continue;
    auto const left = static_cast<std::size_t>(&node - bvh.nodes().data()) + 1;
    for (BvhNode const& child : {bvh.nodes()[left], bvh.nodes()[node.first]}) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(node.low[k], child.low[k]);
        EXPECT_GE(node.high[k], child.high[k]);
      }
    }
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

TEST(Bvh, HoldsEachItemOnceInBoxesThatContainIt) {
  for (std::uint32_t const count : {1U, 3U, 17U, 1000U, 40000U}) {
    auto const boxes = gravel(count, 1);
    expect_sound(Bvh(boxes), boxes);
    expect_sound(Bvh(boxes, 4), boxes);
  }
}

TEST(Bvh, HoldsAManyEqualBoxesAndAsManyInARow) {
  std::vector<BvhBox> equal, row;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    equal.emplace_back(Vec3(1), Vec3(2), i);
    row.emplace_back(Vec3(i, 0, 0), Vec3(i + 1.0, 1, 1), i);
  }
  expect_sound(Bvh(equal), equal);
  expect_sound(Bvh(row), row);
}

/// What a line may meet is what a look at each box finds, in items many enough for runs of
/// neighbours.
TEST(Bvh, WalkFindsWhatALookAtEachBoxFinds) {
  auto const boxes = gravel(20000, 1);
  Bvh const bvh(boxes);
  std::mt19937 numbers(2);
  auto const share = [&] { return static_cast<double>(numbers()) / 0x1p32; };
  for (int k = 0; k < 50; ++k) {
    Ray ray;
    ray.origin = {share(), share(), -1};
    ray.direction = {share() - 0.5, share() - 0.5, 1};
    BoxProbe const probe(ray);
    std::set<std::uint32_t> found, expected;
    double const to = 1e9;
    double entry = 0;
    // Leaves hold few items, all of which are visited with one of them.
    walk(std::span<BvhNode const>(bvh.nodes()), std::span<std::uint32_t const>(bvh.items()), probe,
         0.0, to, [&](std::uint32_t item) {
           BvhBox const& box = boxes[item];
           Vec3 const low(box.side[0], box.side[1], box.side[2]);
           Vec3 const high(-box.side[3], -box.side[4], -box.side[5]);
           if (probe.enter(low, high, 0.0, to, entry)) found.insert(item);
           return true;
         });
    for (BvhBox const& box : boxes) {
      Vec3 const low(box.side[0], box.side[1], box.side[2]);
      Vec3 const high(-box.side[3], -box.side[4], -box.side[5]);
      if (probe.enter(low, high, 0.0, to, entry)) expected.insert(box.item);
    }
    EXPECT_EQ(found, expected);
  }
}

/// Scaling by a power of two gives the same tree.
TEST(Bvh, DoesNotDependOnTheScale) {
  Bvh const one(gravel(20000, 1)), other(gravel(20000, 0x1p40));
  ASSERT_EQ(one.items(), other.items());
  ASSERT_EQ(one.nodes().size(), other.nodes().size());
}

} // namespace
} // namespace abbe::geometry
