// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abbe::render::testing {
namespace {

using Kind = BadSample::Kind;

/// A wall that glows, seen through a ball of glass; the camera stands at <1, 2, 3>.
scene::Scene wall_behind_glass(double emission, scene::DispersionMode mode) {
  scene::Scene scene;
  Vec3 const camera(1, 2, 3);
  scene.camera.location = camera;
  auto const at = [&](Vec3 const& place) {
    return geometry::Transform::translation(camera + place);
  };
  scene.objects.push_back(with_glass(
      object(std::make_shared<geometry::Sphere>(), at({0, 0, 5}), clear()), n_sf11(), mode));
  scene.objects[0].keyword = "sphere";
  auto layers = plain(Vec3(1));
  layers[0].finish->ambient.rgb = Vec3(0);
  layers[0].finish->diffuse = 0;
  layers[0].finish->emission.rgb = Vec3(emission);
  auto const wall = geometry::make_box({-90, -90, 20}, {90, 90, 21});
  auto placed = object(wall->shape, wall->placement.then(at({0, 0, 0})), layers);
  placed.keyword = "box";
  scene.objects.push_back(placed);
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = 4;
  return scene;
}

RenderResult checked(scene::Scene const& scene, int threads = 1) {
  RenderOptions options;
  options.width = options.height = 9;
  options.tile_size = 2;
  options.threads = threads;
  options.check_finite = true;
  auto const plan = plan::make_plan(scene);
  ABBE_ASSERT(plan);
  return render(scene, *plan, options);
}

TEST(CheckFinite, SoundScenesPass) {
  for (auto const& mode : {none(), deterministic(), stochastic(), triangular(), faithful()})
    EXPECT_FALSE(checked(wall_behind_glass(1, mode)).bad_sample);
}

TEST(CheckFinite, SaysWhichPathAndSurfaceMadeIt) {
  auto scene = wall_behind_glass(1, stochastic());
  scene.objects[1].texture->front().finish->emission.rgb = Vec3(std::numeric_limits<double>::max());
  // It hides from the camera and from what is refracted: a mirrored ray must have found it.
  scene.objects[1].no_image = true;
  auto const mirrored = checked(scene).bad_sample;
  ASSERT_TRUE(mirrored);
  EXPECT_TRUE(std::any_of(mirrored->path.begin(), mirrored->path.end(), [](PathStep const& step) {
    return step.kind == PathStep::Kind::Reflected;
  }));
  EXPECT_EQ(mirrored->path.back().keyword, "box");
  scene.objects[1].no_image = false;
  auto const found = checked(scene).bad_sample;
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::Infinite);
  // The first in rows passes the ball by.
  EXPECT_EQ(found->x, 0);
  EXPECT_EQ(found->y, 0);
  ASSERT_EQ(found->path.size(), 1u);
  EXPECT_EQ(found->path[0].keyword, "box");
  EXPECT_NEAR(found->path[0].point.z, 23, 1e-9); // the scene's coordinates, not the camera's

  // A smaller wall is seen through the ball only.
  auto const small = geometry::make_box({-1, -1, 20}, {1, 1, 21});
  scene.objects[1].shape = small->shape;
  scene.objects[1].placement = small->placement.then(geometry::Transform::translation({1, 2, 3}));
  scene.camera.direction = {0, 0, 12};
  auto const through = checked(scene).bad_sample;
  ASSERT_TRUE(through);
  ASSERT_EQ(through->path.size(), 3u);
  EXPECT_EQ(through->path[0].kind, PathStep::Kind::Camera);
  EXPECT_EQ(through->path[0].keyword, "sphere");
  EXPECT_EQ(through->path[0].lanes, 4);
  EXPECT_EQ(through->path[1].kind, PathStep::Kind::Refracted);
  EXPECT_EQ(through->path[1].keyword, "sphere");
  EXPECT_EQ(through->path[2].kind, PathStep::Kind::Refracted);
  EXPECT_EQ(through->path[2].keyword, "box");
  EXPECT_TRUE(through->path[2].met);
}

TEST(CheckFinite, FindsWhatIsNotANumber) {
  auto scene = wall_behind_glass(1, deterministic());
  scene.objects[1].texture->front().finish->emission.rgb = Vec3(NAN);
  auto const bad = checked(scene).bad_sample;
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->kind, Kind::NotANumber);
}

TEST(CheckFinite, NegativeLightIsWrongOnlyWhereTheSceneDoesNotAskForIt) {
  // A negative light source darkens, as in POV-Ray.
  scene::Light lamp;
  lamp.position = {1, 2, 3};
  lamp.colour.rgb = Vec3(-0.25);
  auto scene = wall_behind_glass(0, none());
  scene.objects[1].texture->front().finish->diffuse = 1;
  scene.lights.push_back(lamp);
  EXPECT_FALSE(checked(scene).bad_sample);
  // A finish that makes light negative does not.
  scene.lights[0].colour.rgb = Vec3(0.25);
  scene.objects[1].texture->front().finish->diffuse = -1;
  auto const bad = checked(scene).bad_sample;
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->kind, Kind::Negative);
  ASSERT_FALSE(bad->path.empty());
  EXPECT_EQ(bad->path.back().keyword, "box");
}

TEST(CheckFinite, TheFirstInRowsIsFoundByAnyNumberOfThreads) {
  auto scene = wall_behind_glass(1, stochastic());
  scene.objects[1].texture->front().finish->emission.rgb = Vec3(1e300);
  auto const one = checked(scene, 1).bad_sample;
  ASSERT_TRUE(one);
  for (int const threads : {2, 7}) {
    auto const other = checked(scene, threads).bad_sample;
    ASSERT_TRUE(other);
    EXPECT_EQ(other->x, one->x);
    EXPECT_EQ(other->y, one->y);
    EXPECT_EQ(other->path.size(), one->path.size());
  }
}

TEST(CheckFinite, CostsNothingAndChangesNothingWhenAllIsWell) {
  auto const scene = wall_behind_glass(1, stochastic());
  RenderOptions options;
  options.width = options.height = 9;
  options.check_finite = false;
  auto const plan = plan::make_plan(scene);
  ASSERT_TRUE(plan);
  EXPECT_EQ(render(scene, *plan, options).image.rgb, checked(scene).image.rgb);
}

} // namespace
} // namespace abbe::render::testing
