// SPDX-License-Identifier: MIT
// Warps by closed formulas: unrolled bodies, folded slices, balls that draw the pattern in.
#include "texture/pattern.hpp"
#include "word_parameters.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

/// Where a warp, written as in a scene, puts a point.
Vec3 warped(std::string const& text, Vec3 const& point) {
  WordParameters in(text);
  for (WarpKind const& kind : warp_kinds())
    if (in.accept(kind.keyword)) {
      auto const warp = kind.read(in);
      EXPECT_TRUE(in.at_end() && in.reports.empty()) << text;
      return warp ? warp->apply(point) : Vec3(NAN);
    }
  ADD_FAILURE() << "no such warp: " << text;
  return Vec3(NAN);
}

void expect_place(std::string const& text, Vec3 const& point, Vec3 const& wanted) {
  Vec3 const got = warped(text, point);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], 1e-12) << text << ", axis " << k;
}

TEST(Warps, RepeatFoldsAnAxisIntoOneSlice) {
  expect_place("repeat <.5,0,0>", {1.7, 3, 4}, {0.2, 3, 4});
  expect_place("repeat <0,2,0>", {1, -0.5, 4}, {1, 1.5, 4});
}
TEST(Warps, RepeatMovesEachSliceByItsNumber) {
  expect_place("repeat <1,0,0> offset <0,.25,.5>", {3.25, 1, 1}, {0.25, 1.75, 2.5});
}
TEST(Warps, RepeatMirrorsEachOtherSlice) {
  expect_place("repeat <1,0,0> flip <1,1,0>", {0.3, 2, 5}, {0.3, 2, 5});
  expect_place("repeat <1,0,0> flip <1,1,0>", {1.3, 2, 5}, {0.7, -2, 5});
}

TEST(Warps, PlanarPutsEverythingOnAPlane) {
  expect_place("planar", {1, 2, 3}, {1, 2, 0});
}

// A quarter turn from +x towards +z is a quarter of the unit square's width.
TEST(Warps, CylindricalUnrollsTheTurn) {
  expect_place("cylindrical", {0, 0.7, 2}, {0.25, 0.7, 2});
  expect_place("cylindrical", {-3, -1, 0}, {0.5, -1, 3});
}
TEST(Warps, CylindricalWidensWithTheDistance) {
  expect_place("cylindrical dist_exp 1", {0, 0.7, 2}, {0.5, 0.7, 2});
}
TEST(Warps, SphericalHasThePolesAtTheEnds) {
  expect_place("spherical", {0, 2, 0}, {0, 1, 2});
  expect_place("spherical", {0, -2, 0}, {0, 0, 2});
  double const r = std::sqrt(2.0);
  expect_place("spherical", {0, 1, 1}, {0.25, 0.75, r});
}
TEST(Warps, ToroidalGoesAroundTheTube) {
  // On top of the tube, a quarter of the way around it from its inner side.
  expect_place("toroidal major_radius 2", {2, 0.5, 0}, {0, 0.75, 0.5});
  expect_place("toroidal major_radius 2", {0, 0, 3}, {0.25, 0.5, 1});
}

// (1 - distance / radius)^falloff of the way on, away from the middle.
TEST(Warps, ABlackHoleMovesWhatIsInItsBall) {
  expect_place("black_hole <1,0,0> 2 falloff 1", {2, 0, 0}, {2.5, 0, 0});
  expect_place("black_hole <1,0,0> 2 falloff 2", {2, 0, 0}, {2.25, 0, 0});
  expect_place("black_hole <1,0,0> 2 falloff 1 strength .5", {2, 0, 0}, {2.25, 0, 0});
  expect_place("black_hole <1,0,0> 2 falloff 1 inverse", {2, 0, 0}, {1.5, 0, 0});
  expect_place("black_hole <1,0,0> 2", {4, 0, 0}, {4, 0, 0});
}
TEST(Warps, BlackHolesAreRepeated) {
  expect_place("black_hole <1,1,1> 1 falloff 1 repeat <2,0,0>", {5.5, 1, 1}, {5.75, 1, 1});
  expect_place("black_hole <1,1,1> 1 falloff 1 repeat <2,0,0>", {-0.5, 1, 1}, {-0.25, 1, 1});
}
TEST(Warps, ATooNarrowRepeatIsWidenedToTheBall) {
  // Middle at 1, so that the ball begins at 0; a ball each 2.
  expect_place("black_hole <.5,1,1> 1 falloff 1 repeat <1,0,0>", {3.5, 1, 1}, {3.75, 1, 1});
}
// Ground truth: POV-Ray; the cell at the origin has its point at <.7118, .4367, .3564>.
TEST(Warps, TurbulenceMovesTheMiddleOfARepeatedHole) {
  Vec3 const point(0.5, 0.5, 0.5), middle = point + 0.2 * Vec3(0.7118, 0.4367, 0.3564);
  double const share = 1 - glm::length(point - middle) / 0.4;
  Vec3 const wanted = point + share * (point - middle);
  Vec3 const got = warped("black_hole <.5,.5,.5> .4 falloff 1 repeat 1 turbulence .2", point);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], 1e-4);
  expect_place("black_hole <.5,.5,.5> .4 falloff 1 turbulence .2", point, point);
}

} // namespace
} // namespace abbe::texture
