// SPDX-License-Identifier: MIT
#include "geometry/contact.hpp"

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace abbe::geometry::test {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();
constexpr double share = 0x1p-22; // 2.4e-7

/// Two boxes of 1 x 1 x 1 along x with a gap between them, all `size` times as large.
World boxes(double gap, double size, double contact, bool joins = true) {
  return World({*make_box(Vec3(0), Vec3(size)),
                *make_box(Vec3(1 + gap, 0, 0) * size, Vec3(2 + gap, 1, 1) * size)},
               {{leaf(0), 0xff, joins}, {leaf(1), 0xff, joins}}, contact);
}

/// Out of the first box into the gap, at any angle: how many crossings are one event there?
std::size_t crossings_at_gap(World const& world, double size, Vec3 const& direction) {
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  EXPECT_TRUE(
      world.closest(ray_from(Vec3(.5) * size, direction), nullptr, 0xff, far, *scratch, hit));
  return hit.crossings.size();
}

TEST(Contact, GapsBelowTheShareAreOneEventAtAnyAngle) {
  for (double const size : {0x1p-60, 1.0, 1e9}) {
    for (Vec3 const& direction : {Vec3(1, 0, 0), Vec3(1, .9, .3), Vec3(.6, .59, 0)}) {
      EXPECT_EQ(crossings_at_gap(boxes(0, size, share), size, direction), 2U);
      EXPECT_EQ(crossings_at_gap(boxes(1e-12, size, share), size, direction), 2U);
      EXPECT_EQ(crossings_at_gap(boxes(1e-7, size, share), size, direction), 2U);
      EXPECT_EQ(crossings_at_gap(boxes(2.3e-7, size, share), size, direction), 2U);
      EXPECT_EQ(crossings_at_gap(boxes(2.5e-7, size, share), size, direction), 1U);
      EXPECT_EQ(crossings_at_gap(boxes(1e-7, size, 0), size, direction), 1U);
      EXPECT_EQ(crossings_at_gap(boxes(1e-7, size, share, false), size, direction), 1U);
    }
  }
}

TEST(Contact, BothSurfacesAreLeftBehind) {
  World const world = boxes(1e-7, 1, share);
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit, next;
  Vec3 const direction = glm::normalize(Vec3(1, .3, .2));
  ASSERT_TRUE(world.closest(ray_from(Vec3(.5), direction), nullptr, 0xff, far, *scratch, hit));
  EXPECT_FALSE(hit.crossings[0].entering);
  EXPECT_TRUE(hit.crossings[1].entering);
  Departure from = leave(hit, true);
  ASSERT_TRUE(
      world.closest({hit.point, direction, hit.point_error}, &from, 0xff, far, *scratch, next));
  EXPECT_EQ(next.crossings[0].solid, 1U);
  EXPECT_FALSE(next.crossings[0].entering);
  EXPECT_GT(next.t, .5);
  // Back into the first box.
  from = leave(hit, false);
  Vec3 const back(-direction.x, direction.y, direction.z);
  ASSERT_TRUE(world.closest({hit.point, back, hit.point_error}, &from, 0xff, far, *scratch, next));
  EXPECT_EQ(next.crossings.size(), 1U);
  EXPECT_EQ(next.crossings[0].solid, 0U);
  EXPECT_FALSE(next.crossings[0].entering);
  EXPECT_GT(next.t, .5);
}

/// A ball in a hollow of another body, a little too small: from shell to ball and from ball to
/// shell.
TEST(Contact, CurvedSurfacesOfAnyKind) {
  double const gap = 1e-7;
  auto const in_hollow = [&](PlacedShape hollow, PlacedShape filling) {
    return World({*make_box(Vec3(-4), Vec3(4)), std::move(hollow), std::move(filling)},
                 {{node(Op::Difference, {leaf(0), leaf(1)}), 0xff, true}, {leaf(2), 0xff, true}},
                 share);
  };
  World const balls = in_hollow(*make_sphere(Vec3(0), 1), *make_sphere(Vec3(0), 1 - gap));
  World const rings = in_hollow(*make_torus(2, 1), *make_torus(2, 1 - gap));
  ScratchPtr const scratch = World::make_scratch();
  Dice dice(3);
  for (World const* const world : {&balls, &rings}) {
    for (int i = 0; i < 500; ++i) {
      Vec3 const target = world == &balls ? dice.in_cube(.4) : Vec3(2, 0, 0) + dice.in_cube(.4);
      Vec3 const origin = target + 3.5 * dice.direction() * Vec3(.3, 1, .3);
      Ray ray = ray_from(Vec3(target.x, -3.5, target.z), Vec3(0, 1, 0));
      ray.direction = glm::normalize(target - ray.origin + Vec3(origin.x * .01, 0, 0));
      Departure from;
      bool departs = false;
      int sides[2] = {0, 0};
      HitGroup hit;
      for (int step = 0; step < 12; ++step) {
        if (!world->closest(ray, departs ? &from : nullptr, 0xff, far, *scratch, hit)) break;
        if (hit.crossings.size() == 2) ++sides[hit.crossings[1].entering];
        from = leave(hit, true);
        departs = true;
        ray = {hit.point, ray.direction, hit.point_error};
      }
      EXPECT_GE(sides[0], 1) << i;
      EXPECT_EQ(sides[0], sides[1]) << i;
    }
  }
}

TEST(Contact, SomethingInTheGapPartsThem) {
  World const world({*make_box(Vec3(0), Vec3(1)), *make_box(Vec3(1 + 2e-7, 0, 0), Vec3(2, 1, 1)),
                     *make_box(Vec3(1 + .8e-7, 0, 0), Vec3(1 + 1.2e-7, 1, 1))},
                    {{leaf(0), 0xff, true}, {leaf(1), 0xff, true}, {leaf(2), 0xff, false}}, share);
  EXPECT_EQ(crossings_at_gap(world, 1, Vec3(1, 0, 0)), 1U);
}

TEST(Contact, OnlyNeighboursArePartners) {
  auto const box = [](double x) { return Bounds{Vec3(x, 0, 0), Vec3(x + 1, 1, 1), false}; };
  Bounds all;
  all.infinite = true;
  std::vector<Bounds> const some = {box(5), box(0), Bounds{}, box(1), box(2.5)};
  Contacts const contacts(some, .01);
  EXPECT_TRUE(contacts.any());
  EXPECT_EQ(contacts.reach(1, 3), .01);
  EXPECT_EQ(contacts.reach(3, 1), .01);
  EXPECT_EQ(contacts.reach(3, 4), 0);
  EXPECT_EQ(contacts.reach(0), 0);
  EXPECT_FALSE(Contacts(some, 0).any());
  std::vector<Bounds> const sea = {all, box(3), all};
  Contacts const shore(sea, .01);
  EXPECT_EQ(shore.reach(0, 1), .01);
  EXPECT_EQ(shore.reach(0, 2), 0); // neither has an extent
}

} // namespace
} // namespace abbe::geometry::test
