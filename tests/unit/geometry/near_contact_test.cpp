// SPDX-License-Identifier: MIT
#include "geometry/shapes/cylinder.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace abbe::geometry::test {
namespace {

/// Two solids whose facing surfaces are apart, or overlap, by from nothing to many times the errors
/// of crossings. A ray that goes from surface to surface, through or back and bent, must know which
/// solids it is in: what it enters it leaves, and far away it is in none.
struct Losses {
  int rays = 0, lost = 0, stuck = 0;
};

Losses follow_between(World const& world, Transform const& place, Dice& dice, int rays) {
  Losses losses;
  ScratchPtr const scratch = World::make_scratch();
  for (int i = 0; i < rays; ++i) {
    Vec3 const target = place.point(Vec3(0, .5, 0) + dice.in_cube(.5) * Vec3(1, 1.2, 1));
    Vec3 direction = glm::normalize(place.vector(dice.direction()));
    Ray ray = ray_from(target - 4.0 * direction, direction);
    Departure from;
    bool departs = false;
    int inside[2] = {0, 0};
    bool lost = false;
    for (int depth = 0; depth < 40; ++depth) {
      HitGroup hit;
      if (!world.closest(ray, departs ? &from : nullptr, 0xff,
                         std::numeric_limits<double>::infinity(), *scratch, hit)) {
        break;
      }
      bool const through = depth > 12 || dice.below(2) == 0;
      for (SurfaceCrossing const& c : hit.crossings) {
        int& count = inside[c.solid];
        lost = lost || count != (c.entering ? 0 : 1);
        if (through) count = c.entering ? 1 : 0;
      }
      SurfaceCrossing const& c = hit.crossings.front();
      Vec3 normal = world.geometric_normal(c.primitive, c.face, hit.point);
      if (glm::dot(normal, ray.direction) > 0) normal = -normal;
      Vec3 next = ray.direction;
      if (!through) {
        next -= 2 * glm::dot(next, normal) * normal;
      } else if (depth <= 12) {
        next = glm::normalize(next - normal * dice.number(-.2, .4));
        if (glm::dot(next, normal) >= 0) next = ray.direction;
      }
      from = leave(hit, through);
      departs = true;
      ray = {hit.point, next, hit.point_error};
    }
    ++losses.rays;
    losses.lost += lost;
    losses.stuck += inside[0] != 0 || inside[1] != 0;
  }
  return losses;
}

TEST(NearlyTouching, WhatIsEnteredIsLeft) {
  for (double const gap :
       {0.0, 1e-16, -1e-16, 1e-15, -1e-15, 1e-14, -1e-14, 1e-13, -1e-13, 1e-12, -1e-12, 1e-11}) {
    Losses all;
    for (int turn = 0; turn < 6; ++turn) {
      Dice dice(static_cast<unsigned>(turn));
      Transform const place =
          turn == 0 ? Transform{}
                    : Transform::rotation(dice.in_cube(180))
                          .then(Transform::translation(dice.in_cube(turn % 2 == 0 ? 100 : 1)));
      World const world(
          {moved(*make_cylinder({0, 0, 0}, {0, 1, 0}, .5, false), place),
           moved(*make_cylinder({0, .1, 0}, {0, 1.2, 0}, .45, false), place),
           moved(*make_cylinder({0, .1 - gap, 0}, {0, .8, 0}, .45 + gap, false), place)},
          {{node(Op::Difference, {leaf(0), leaf(1)})}, {leaf(2)}});
      Losses const here = follow_between(world, place, dice, 4000);
      all.rays += here.rays;
      all.lost += here.lost;
      all.stuck += here.stuck;
    }
    EXPECT_EQ(all.lost, 0) << gap;
    EXPECT_EQ(all.stuck, 0) << gap;
  }
}

} // namespace
} // namespace abbe::geometry::test
