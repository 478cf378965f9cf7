// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"
#include "geometry/line.hpp"

#include <gtest/gtest.h>

/// What a fan finds is what World::closest and World::occluded find for each of its rays.
namespace abbe::geometry::test {

inline void compare_fan_occlusion(World const& world, FanLines const& lines, Departure const* from,
                                  double const* t_max, Scratch& scratch) {
  bool blocked[fan_width], clear[fan_width];
  world.occluded_fan(lines, from, 0xff, t_max, scratch, blocked, clear);
  for (std::size_t k = 0; k < lines.count; ++k) {
    EXPECT_FALSE(blocked[k] && clear[k]);
    if (!blocked[k] && !clear[k]) continue;
    EXPECT_EQ(blocked[k], world.occluded(lines.get(k), from, 0xff, t_max[k], scratch));
  }
}

inline void expect_same_group(HitGroup const& alone, HitGroup const& together) {
  EXPECT_EQ(alone.t, together.t);
  EXPECT_EQ(alone.error, together.error);
  EXPECT_EQ(alone.point, together.point);
  EXPECT_EQ(alone.point_error, together.point_error);
  ASSERT_EQ(alone.crossings.size(), together.crossings.size());
  for (std::size_t i = 0; i < alone.crossings.size(); ++i) {
    SurfaceCrossing const &a = alone.crossings[i], &b = together.crossings[i];
    EXPECT_EQ(a.t, b.t);
    EXPECT_EQ(a.solid, b.solid);
    EXPECT_EQ(a.primitive, b.primitive);
    EXPECT_EQ(a.face, b.face);
    EXPECT_EQ(a.entering, b.entering);
    EXPECT_EQ(a.toggles, b.toggles);
  }
  ASSERT_EQ(alone.members.size(), together.members.size());
  for (std::size_t i = 0; i < alone.members.size(); ++i) {
    EXPECT_EQ(alone.members[i].primitive, together.members[i].primitive);
    EXPECT_EQ(alone.members[i].face, together.members[i].face);
    EXPECT_EQ(alone.members[i].was_entering, together.members[i].was_entering);
  }
}

/// Rays of a fan, by what it said of them.
struct FanCounts {
  int single = 0, pairs = 0;
};

/// Asks for the rays together and one by one.
inline FanCounts compare_fan(World const& world, FanLines& lines, Departure const* from,
                             double const* t_max, Scratch& scratch) {
  lines.fill();
  FanHits hits;
  world.closest_fan(lines, from, 0xff, nullptr, scratch, hits);
  compare_fan_occlusion(world, lines, from, t_max, scratch);
  FanCounts counts;
  for (std::size_t k = 0; k < lines.count; ++k) {
    HitGroup alone, together;
    bool const found = world.closest(lines.get(k), from, 0xff, infinity, scratch, alone);
    FanHit const& hit = hits.hit[k];
    EXPECT_EQ(found, hit.kind != FanHit::Kind::Nothing);
    if (hit.kind == FanHit::Kind::Single) {
      hits.write(k, together);
      ++counts.single;
    } else if (hit.kind == FanHit::Kind::Pair) {
      world.closest_pair(lines.get(k), hits.pair[k], 0xff, infinity, scratch, together);
      ++counts.pairs;
    } else {
      continue;
    }
    expect_same_group(alone, together);
  }
  return counts;
}

} // namespace abbe::geometry::test
