// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"
#include "tests/unit/geometry/fan_batch.hpp"

#include <gtest/gtest.h>

/// What a batch of rays finds is what World::closest and World::occluded find for each of them.
namespace abbe::geometry::test {

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

/// The ray's hit as World::closest tells it.
inline HitGroup group_of(Hits const& hits, std::size_t k) {
  RayHit const& hit = hits.hit[k];
  if (hit.kind == RayHit::Kind::Group) return hits.groups[hits.group[k]];
  HitGroup group;
  group.t = hits.t[k];
  group.error = hits.error[k];
  group.point = hits.point.get(k);
  group.point_error = hits.point_error.get(k);
  group.crossings.push_back(
      {hit.solid, hit.primitive, hit.face, hits.t[k], hit.entering, hit.toggles});
  group.members.push_back({hit.primitive, hit.face, hit.was_entering});
  return group;
}

/// Rays of a fan, by what they met.
struct FanCounts {
  int single = 0, pairs = 0;
};

/// Asks for the rays together and one by one.
inline FanCounts compare_fan(World const& world, FanLines& lines, Departure const* from,
                             double const* t_max, Scratch& scratch) {
  Groups groups;
  std::vector<RayStart> starts(lines.count);
  if (from != nullptr) {
    groups.add().members = from->on;
    for (RayStart& start : starts) start = {0, 0, RayStart::Kind::Group, false, from->through};
  }
  RayLines const rays = batch_of(lines, starts.data(), &groups);
  Hits hits;
  world.intersect(rays, 0xff, nullptr, scratch, hits);
  std::vector<std::uint8_t> blocked(lines.count);
  world.occluded(rays, 0xff, t_max, scratch, blocked.data());
  FanCounts counts;
  for (std::size_t k = 0; k < lines.count; ++k) {
    EXPECT_EQ(blocked[k] != 0, world.occluded(lines.get(k), from, 0xff, t_max[k], scratch));
    HitGroup alone;
    bool const found = world.closest(lines.get(k), from, 0xff, infinity, scratch, alone);
    EXPECT_EQ(found, hits.hit[k].kind != RayHit::Kind::Nothing);
    if (!found) continue;
    counts.single += hits.hit[k].kind == RayHit::Kind::Single ? 1 : 0;
    counts.pairs += alone.crossings.size() == 2 ? 1 : 0;
    expect_same_group(alone, group_of(hits, k));
  }
  return counts;
}

} // namespace abbe::geometry::test
