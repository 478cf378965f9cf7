// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"

#include <cmath>

namespace abbe::lang {
namespace {

/// Rounding of a dozen operations on numbers of order 10.
constexpr double rounding = 1e-14;

scene::Camera camera(std::string const& items) {
  return scene_of("camera { " + items + " }").camera;
}

TEST(Camera, DefaultIsPovRays) {
  auto const c = scene_of("").camera;
  EXPECT_EQ(c.location, Vec3(0));
  EXPECT_EQ(c.direction, Vec3(0, 0, 1));
  EXPECT_EQ(c.up, Vec3(0, 1, 0));
  EXPECT_EQ(c.right, Vec3(1.33, 0, 0));
}

TEST(Camera, LookAtTurnsAndKeepsLengths) {
  auto const c = camera("location <0, 0, -10> up 3*y right 4*x direction 2*z look_at <10, 0, 0>");
  double const s = std::sqrt(0.5);
  expect_near(c.direction, Vec3(2 * s, 0, 2 * s), rounding);
  expect_near(c.up, Vec3(0, 3, 0), rounding);
  expect_near(c.right, Vec3(4 * s, 0, -4 * s), rounding);
}

TEST(Camera, AngleSetsTheDirectionFromRight) {
  // tan(45 deg) = 1: |direction| = |right| / 2
  auto const c = camera("angle 90 right 4*x");
  expect_near(c.direction, Vec3(0, 0, 2), rounding);
}

TEST(Camera, OrderOfItemsDoesNotMatter) {
  auto const a =
      camera("location <1, 2, -5> right 1.6*x angle 40 sky <0.1, 1, 0> look_at <0, 1, 0>");
  auto const b =
      camera("look_at <0, 1, 0> angle 40 sky <0.1, 1, 0> right 1.6*x location <1, 2, -5>");
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.right, b.right);
}

TEST(Camera, KeepsItsHandedness) {
  auto const c = camera("right -1.33*x location -z look_at 0");
  expect_near(c.right, Vec3(-1.33, 0, 0), rounding);
}

TEST(Camera, OrthographicFrameGrowsWithTheDistanceUnlessItIsGiven) {
  auto const grown = camera("orthographic location <0, 0, -5> look_at 0");
  expect_near(grown.right, Vec3(1.33 * 5, 0, 0), rounding);
  expect_near(grown.up, Vec3(0, 5, 0), rounding);
  auto const given = camera("orthographic location <0, 0, -5> right 2*x look_at 0");
  expect_near(given.right, Vec3(2, 0, 0), rounding);
  expect_near(given.up, Vec3(0, 1, 0), rounding);
}

TEST(Camera, TransformsActOnTheFinishedCamera) {
  auto const c = camera("translate x location -z*2 look_at 0 rotate 90*y");
  // rotate 90*y takes z to x and x to -z; the translation comes first
  expect_near(c.location, Vec3(-2, 0, -1), rounding);
  expect_near(c.direction, Vec3(1, 0, 0), rounding);
  expect_near(c.right, Vec3(0, 0, -1.33), rounding);
}

TEST(Camera, LookingAlongSkyKeepsRight) {
  auto const e = evaluate("camera { location 5*y look_at 0 }");
  EXPECT_EQ(e.diagnostics.size(), 1u);
  EXPECT_TRUE(e.ok());
  expect_near(e.scene.camera.direction, Vec3(0, -1, 0), rounding);
  expect_near(e.scene.camera.right, Vec3(1.33, 0, 0), rounding);
  expect_near(e.scene.camera.up, Vec3(0, 0, 1), rounding);
}

TEST(Camera, VectorsInOnePlaneAreRightHanded) {
  // As POV-Ray: (up x direction) . right is 0, which is not left-handed: right is turned.
  auto const c = camera("location -5*z up z right 4/3*x look_at 0");
  expect_near(c.right, Vec3(-4.0 / 3, 0, 0), rounding);
  expect_near(c.up, Vec3(0, 1, 0), rounding);
}

TEST(Camera, ARightHandedOneAlongSkyTurnsRightTwice) {
  // up = direction x right as given, then right is turned, as in POV-Ray.
  auto const e = evaluate("camera { location 6*y right -1.33*x look_at 0 }");
  EXPECT_EQ(e.diagnostics.size(), 1u);
  expect_near(e.scene.camera.right, Vec3(1.33, 0, 0), rounding);
  expect_near(e.scene.camera.up, Vec3(0, 0, -1), rounding);
}

TEST(Camera, AnAngleOfZeroLeavesTheDirection) {
  auto const c = camera("location -5*z right 4*x up 3*y direction 2*z look_at 0 angle 0");
  expect_near(c.direction, Vec3(0, 0, 2), rounding);
  // As any angle, it makes the frame of an orthographic camera grow: by distance / |direction|.
  auto const flat = camera("orthographic location -5*z right 4*x up 3*y look_at 0 angle 0");
  expect_near(flat.right, Vec3(20, 0, 0), rounding);
  expect_near(flat.up, Vec3(0, 15, 0), rounding);
}

TEST(Camera, VectorsInOnePlaneWarnAndThoseThatCancelOutAreErrors) {
  EXPECT_TRUE(evaluate("camera { up z }").ok());
  EXPECT_EQ(codes("camera { up z }"), "E0352");
  EXPECT_TRUE(evaluate("camera { orthographic up x }").ok());
  EXPECT_FALSE(evaluate("camera { up 4*z }").ok()); // a quarter of the picture below its middle
  EXPECT_TRUE(evaluate("camera { up 0.5*z right -0.5*z }").ok()); // on one line, but never zero
  EXPECT_FALSE(evaluate("camera { up z right -z }").ok());
}

TEST(Camera, ACopyTakesTransformsOnly) {
  auto const c =
      scene_of("#declare C = camera { location -5*z look_at 0 } camera { C translate y }").camera;
  expect_near(c.location, Vec3(0, 1, -5), rounding);
  EXPECT_NE(codes("#declare C = camera { location -5*z } camera { C angle 40 }"), "");
}

TEST(Camera, DegenerateOnesAreErrors) {
  EXPECT_EQ(codes("camera { location <1, 2, 3> look_at <1, 2, 3> }"), "E0352");
  EXPECT_EQ(codes("camera { right 0*x }"), "E0352");
  EXPECT_EQ(codes("camera { angle 180 }"), "E0353");
  EXPECT_EQ(codes("camera { fisheye angle 361 }"), "E0353");
  EXPECT_EQ(codes("camera { fisheye angle -1 }"), "E0353");
  EXPECT_EQ(codes("camera { fisheye angle 100, 50 }"), "E0353");
  EXPECT_EQ(codes("camera { cylinder 5 }"), "E0353");
  EXPECT_EQ(codes("camera { aperture -1 blur_samples 10 }"), "E0353");
  EXPECT_EQ(codes("camera { location y aperture 1 blur_samples 10 focal_point y }"), "E0352");
  EXPECT_EQ(codes("camera { fisheye aperture 1 blur_samples 10 }"), "E0901");
}

TEST(Camera, CurvedOnesHaveAngles) {
  auto const angles = [](std::string const& items) {
    auto const c = scene_of("camera { " + items + " }").camera;
    return Vec2(c.angle_deg, c.vertical_angle_deg);
  };
  EXPECT_EQ(angles("fisheye"), Vec2(90, 45));
  EXPECT_EQ(angles("spherical"), Vec2(360, 180));
  EXPECT_EQ(angles("spherical angle 200"), Vec2(200, 100));
  EXPECT_EQ(angles("spherical angle 200, 30"), Vec2(200, 30));
  EXPECT_EQ(scene_of("camera { cylinder 3 angle 100 }").camera.cylinder_type, 3);
}

TEST(Camera, TheDistanceOfFocusIsThatOfItsPoint) {
  auto const c =
      scene_of("camera { location -5*z aperture 0.4 blur_samples 3, 20 focal_point 3*y-z "
               "confidence 0.9 variance 1/200 }")
          .camera;
  EXPECT_EQ(c.aperture, 0.4);
  EXPECT_EQ(c.blur_samples, 20);
  EXPECT_NEAR(c.focal_distance, 5, 1e-15);
  EXPECT_EQ(scene_of("camera { aperture 0.4 blur_samples 20 }").camera.focal_distance, 1);
}

TEST(Camera, WhatHasNoEffectIsTold) {
  EXPECT_EQ(codes("camera { panoramic angle 100 }"), "E0257");
  EXPECT_EQ(codes("camera { aperture 0.4 }"), "E0257");
}

TEST(Camera, TheLastOneIsUsed) {
  auto const e = evaluate("camera { location x } camera { location y }");
  EXPECT_TRUE(e.ok());
  EXPECT_EQ(e.diagnostics.size(), 1u);
  EXPECT_EQ(e.scene.camera.location, Vec3(0, 1, 0));
}

} // namespace
} // namespace abbe::lang
