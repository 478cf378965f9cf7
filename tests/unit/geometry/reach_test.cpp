// SPDX-License-Identifier: MIT
#include "geometry/placed.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"

#include "scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

/// Reach may only say "misses" where crossings() has nothing that counts.
namespace abbe::geometry::test {
namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

std::vector<PlacedShape> one_of_each() {
  return {*make_sphere({0.3, -0.2, 0.1}, 0.8),
          *make_box({-1, -0.1, -0.5}, {0.4, 0.3, 2}),
          *make_cylinder({0, -1, 0.2}, {0.3, 1, 0}, 0.2, true),
          *make_cone({0, -1, 0}, 0.7, {0.4, 1, 0.1}, 0.1, false),
          *make_torus(1, 0.3),
          *make_prism({{{-1, -1}, {1, -0.8}, {0.2, 0.1}, {0.9, 1.1}, {-1, 0.7}}}, -0.3, 0.6, false),
          *make_plane({0.3, 1, -0.2}, 0.4)};
}

Transform any_place(Dice& dice, double size, double far) {
  Transform place = Transform::scaling(Vec3(size));
  if (dice.below(2) == 0) place = Transform::scaling(Vec3(1, 3, 0.1)).then(place);
  if (dice.below(2) == 0) place = Transform::rotation(dice.in_cube(90)).then(place);
  if (dice.below(3) == 0) {
    place = place.then(Transform::scaling(Vec3(0.2, 1, 1))).then(Transform::rotation({10, 20, 0}));
  }
  return place.then(Transform::translation(dice.in_cube(far * size)));
}

/// A line that passes the middle of the placed shape at some one to two of its extents, in steps
/// down to a rounding: where a decision is close.
Ray close_line(Dice& dice, PlacedShape const& placed, double size, double away) {
  Vec3 const middle = placed.placement.transform().offset;
  Vec3 const direction = dice.direction();
  Vec3 const side = glm::normalize(glm::cross(direction, dice.direction()));
  double const apart =
      dice.below(2) == 0 ? 1.0 + std::exp2(-dice.below(50)) : 2.5 * dice.number(0, 1);
  return {middle + side * (size * apart) - direction * (away * size), direction, Vec3(0)};
}

TEST(Reach, MissesOnlyWhatHasNoCrossingThatCounts) {
  Dice dice(11);
  int said_no = 0, asked = 0;
  for (int i = 0; i < 3000; ++i) {
    double const size = std::pow(10.0, dice.below(9) * 3 - 12);
    double const far = std::pow(10.0, dice.below(4) * 2);
    for (PlacedShape const& shape : one_of_each()) {
      PlacedShape const there = moved(shape, any_place(dice, size, far));
      Placed const placed(there);
      Ray const ray =
          close_line(dice, there, size, dice.below(2) == 0 ? far : -2 * dice.number(0, 1));
      double const until = dice.below(2) == 0 ? everywhere : size * far * 2 * dice.number(0, 1);
      Crossings crossings;
      placed.shape().crossings(placed.to_object(ray), nullptr, crossings);
      bool counts = false;
      for (Crossing const& c : crossings) counts = counts || (c.t > 0 && c.t <= until);
      bool const misses = placed.misses(ray, until);
      EXPECT_FALSE(misses && counts) << i;
      ++asked;
      said_no += misses ? 1 : 0;
    }
  }
  // Worth asking: about half of these lines stay outside of the ball, or turn away.
  EXPECT_GT(said_no, asked / 4);
}

TEST(Reach, SaysTheSameAtEachScale) {
  Dice dice(12);
  for (int i = 0; i < 300; ++i) {
    for (PlacedShape const& shape : one_of_each()) {
      PlacedShape const there = moved(shape, any_place(dice, 1, 10));
      Ray const ray = close_line(dice, there, 1, 3);
      for (double const scale : {0x1p-60, 0x1p90}) {
        Placed const other(moved(there, Transform::scaling(Vec3(scale))));
        Ray const scaled{ray.origin * scale, ray.direction, Vec3(0)};
        EXPECT_EQ(Placed(there).misses(ray, 4), other.misses(scaled, 4 * scale));
      }
    }
  }
}

TEST(Reach, SaysNothingOfSizesWhoseSquaresOverflow) {
  for (double const size : {0x1p-500, 0x1p500}) {
    Placed const placed(*make_sphere({0, 0, 0}, size));
    Ray const past{{0, 3 * size, -5 * size}, {0, 0, 1}, Vec3(0)};
    EXPECT_FALSE(placed.misses(past, everywhere));
  }
}

} // namespace
} // namespace abbe::geometry::test
