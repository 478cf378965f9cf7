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

/// Asks for the rays together and one by one. @return rays whose answer was Single
inline int compare_fan(World const& world, FanLines& lines, Departure const* from,
                       double const* t_max, Scratch& scratch) {
  lines.fill();
  FanHits hits;
  world.closest_fan(lines, from, 0xff, nullptr, scratch, hits);
  compare_fan_occlusion(world, lines, from, t_max, scratch);
  int single = 0;
  for (std::size_t k = 0; k < lines.count; ++k) {
    HitGroup alone, together;
    bool const found = world.closest(lines.get(k), from, 0xff, infinity, scratch, alone);
    FanHit const& hit = hits.hit[k];
    if (hit.kind == FanHit::Kind::Unclear) {
      EXPECT_TRUE(found);
      continue;
    }
    EXPECT_EQ(found, hit.kind == FanHit::Kind::Single);
    if (!found || hit.kind != FanHit::Kind::Single) continue;
    hits.write(k, together);
    EXPECT_EQ(alone.t, together.t);
    EXPECT_EQ(alone.error, together.error);
    EXPECT_EQ(alone.point, together.point);
    EXPECT_EQ(alone.point_error, together.point_error);
    EXPECT_EQ(alone.crossings.size(), 1U);
    EXPECT_EQ(alone.members.size(), 1U);
    SurfaceCrossing const &a = alone.crossings[0], &b = together.crossings[0];
    EXPECT_EQ(a.solid, b.solid);
    EXPECT_EQ(a.primitive, b.primitive);
    EXPECT_EQ(a.face, b.face);
    EXPECT_EQ(a.entering, b.entering);
    EXPECT_EQ(a.toggles, b.toggles);
    EXPECT_EQ(alone.members[0].was_entering, together.members[0].was_entering);
    ++single;
  }
  return single;
}

} // namespace abbe::geometry::test
