// SPDX-License-Identifier: MIT
#include "geometry/world.hpp"

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>

namespace abbe::geometry::test {
namespace {

TEST(World, SphereIsMetInFrontAndFromInside) {
  World const world({*make_sphere({0, 0, 5}, 2)}, {{leaf(0)}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  ASSERT_TRUE(
      world.closest(ray_from({0, 0, 0}, {0, 0, 1}), nullptr, 0xff, infinity, *scratch, hit));
  EXPECT_EQ(hit.t, 3.0);
  EXPECT_TRUE(hit.crossings[0].entering);
  EXPECT_EQ(world.normal(0, 0, hit.point), Vec3(0, 0, -1));
  Departure const in = leave(hit, true);
  ASSERT_TRUE(
      world.closest({hit.point, {0, 0, 1}, hit.point_error}, &in, 0xff, infinity, *scratch, hit));
  EXPECT_EQ(hit.t, 4.0);
  EXPECT_FALSE(hit.crossings[0].entering);
  EXPECT_TRUE(world.occluded(ray_from({0, 0, 0}, {0, 0, 1}), nullptr, 1, 3.5, *scratch));
  EXPECT_FALSE(world.occluded(ray_from({0, 0, 0}, {0, 0, 1}), nullptr, 1, 2.5, *scratch));
}

TEST(World, SolidMinusItselfIsNothingAndWithItselfIsItself) {
  auto const a = *make_box({0, 0, 0}, {1, 1, 1});
  World const none({a, a}, {{node(Op::Difference, {leaf(0), leaf(1)})}});
  World const same({a, a}, {{node(Op::Intersection, {leaf(1), leaf(0)})}});
  ScratchPtr const scratch = World::make_scratch(), other = World::make_scratch();
  HitGroup hit;
  Ray const ray = ray_from({.3, .4, -3}, {0.01, 0.02, 1});
  EXPECT_FALSE(none.closest(ray, nullptr, 0xff, infinity, *scratch, hit));
  ASSERT_TRUE(same.closest(ray, nullptr, 0xff, infinity, *other, hit));
  EXPECT_EQ(hit.t, 3.0);
  EXPECT_EQ(hit.crossings[0].primitive, 0U);
  EXPECT_EQ(hit.members.size(), 2U);
}

TEST(World, TouchingSolidsAreOneGroup) {
  World const world({*make_box({0, 0, 0}, {1, 1, 1}), *make_box({0, 0, 1}, {1, 1, 2})},
                    {{leaf(0)}, {leaf(1)}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  Ray const ray = ray_from({.5, .5, .5}, {0.1, 0.2, 1});
  ASSERT_TRUE(world.closest(ray, nullptr, 0xff, infinity, *scratch, hit));
  ASSERT_EQ(hit.crossings.size(), 2U);
  EXPECT_FALSE(hit.crossings[0].entering);
  EXPECT_TRUE(hit.crossings[1].entering);
  Departure const on = leave(hit, true);
  ASSERT_TRUE(world.closest({hit.point, ray.direction, hit.point_error}, &on, 0xff, infinity,
                            *scratch, hit));
  EXPECT_NEAR(hit.t, 1.0, 1e-15);
  EXPECT_EQ(hit.crossings.size(), 1U);
  EXPECT_FALSE(hit.crossings[0].entering);
  std::vector<SolidId> in;
  world.containing({.5, .5, 1.5}, *scratch, in);
  EXPECT_EQ(in, (std::vector<SolidId>{1}));
}

TEST(World, ClipShowsTheFirstInsideTheOthersWithoutCaps) {
  World const world({*make_sphere({0, 0, 0}, 1), *make_plane({0, 0, -1}, 0)},
                    {{node(Op::Clip, {leaf(0), leaf(1)})}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  // The half with z < 0 is cut away: the ray meets the far half from inside.
  ASSERT_TRUE(
      world.closest(ray_from({0, 0, -3}, {0, 0, 1}), nullptr, 0xff, infinity, *scratch, hit));
  EXPECT_EQ(hit.t, 4.0);
  EXPECT_EQ(hit.crossings[0].primitive, 0U);
  EXPECT_FALSE(hit.crossings[0].entering);
}

} // namespace
} // namespace abbe::geometry::test
