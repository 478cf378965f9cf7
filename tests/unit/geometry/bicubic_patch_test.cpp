// SPDX-License-Identifier: MIT
#include "geometry/placed.hpp"
#include "geometry/shapes/bicubic_patch.hpp"
#include "scene.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::geometry::test {
namespace {

/// x = 3 u, z = 3 v, and of height 2 in the middle four points: y = 2 (3 u (1 - u)) (3 v (1 - v)).
BicubicPatch dome(int steps, double flatness = 0) {
  BicubicPatch patch;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      bool const inner = i % 3 != 0 && j % 3 != 0;
      patch.points[i][j] = Vec3(static_cast<double>(j), inner ? 2 : 0, static_cast<double>(i));
    }
  patch.u_steps = patch.v_steps = steps;
  patch.flatness = flatness;
  return patch;
}
double height(double u, double v) {
  return 18 * u * (1 - u) * v * (1 - v);
}
/// Where a line straight down meets the patch, and the normal there.
struct Met {
  double y;
  Vec3 normal;
};
Met met(PlacedShape const& shape, double u, double v) {
  Placed const placed(shape);
  Ray const ray = ray_from({3 * u, 5, 3 * v}, {0, -1, 0});
  Crossings out;
  placed.shape().crossings(placed.to_object(ray), nullptr, out);
  EXPECT_EQ(out.size(), 1U);
  if (out.empty()) return {NAN, {}};
  return {5 - out[0].t, placed.normal(out[0].face, ray.origin + out[0].t * ray.direction, false)};
}

TEST(BicubicPatch, ThePointsOfTheGridAreOnTheSurfaceWithItsNormals) {
  auto const shape = *make_bicubic_patch(dome(3));
  for (double const u : {.125, .375, .5, .875}) {
    for (double const v : {.25, .625, .75}) {
      Met const at = met(shape, u, v);
      EXPECT_NEAR(at.y, height(u, v), 1e-14);
      // Along rows x across rows.
      Vec3 const across(-6 * (1 - 2 * u) * v * (1 - v), 1, -6 * (1 - 2 * v) * u * (1 - u));
      EXPECT_NEAR(std::fabs(glm::dot(at.normal, glm::normalize(across))), 1, 1e-14);
    }
  }
}

TEST(BicubicPatch, MoreStepsComeNearerByTheirSquare) {
  double const u = .31, v = .57;
  double last = 1;
  for (int const steps : {2, 4, 6}) {
    double const off = std::fabs(met(*make_bicubic_patch(dome(steps)), u, v).y - height(u, v));
    EXPECT_LT(off, last / 4);
    last = off;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(BicubicPatch, FlatPiecesAreNotHalved) {
  // All points are within 2 of the plane through the corners.
  EXPECT_NEAR(met(*make_bicubic_patch(dome(4, 2.1)), .5, .25).y, 0, 1e-14);
  EXPECT_NEAR(met(*make_bicubic_patch(dome(4, .001)), .5, .25).y, height(.5, .25), 1e-14);
}

TEST(BicubicPatch, WithoutAnAreaThereIsNone) {
  BicubicPatch patch = dome(2);
  for (auto& row : patch.points)
    for (Vec3& point : row) point.z = point.y = 0;
  EXPECT_FALSE(make_bicubic_patch(patch));
  patch.points[1][1].x = NAN;
  EXPECT_FALSE(make_bicubic_patch(patch));
}

} // namespace
} // namespace abbe::geometry::test
