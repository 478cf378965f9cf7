// SPDX-License-Identifier: MIT
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace abbe::render::testing {
namespace {

/// Balls in a row, two of each colour, one of them in two layers; the first glows as given.
scene::Scene row_of_balls(double emission) {
  scene::Scene scene;
  scene.lights.push_back({});
  scene.lights.back().position = {0, 5, -9};
  for (int i = 0; i < 8; ++i) {
    auto layers = plain(Vec3(1, 0.1 * (i / 2), 0.5));
    if (i == 5) layers.push_back(plain(Vec3(0, 1, 0), 0.5).front());
    if (i == 0) layers[0].finish->emission.rgb = Vec3(emission);
    auto ball = object(std::make_shared<geometry::Sphere>(),
                       geometry::Transform::scaled_and_moved(Vec3(0.5), {i - 3.5, 0, 8}), layers);
    ball.keyword = "sphere";
    scene.objects.push_back(ball);
  }
  return scene;
}

RenderOptions small() {
  RenderOptions options;
  options.width = 40;
  options.height = 30;
  options.threads = 1;
  options.check_finite = true;
  return options;
}

TEST(TakenScene, HasThePictureOfAKeptOne) {
  auto scene = row_of_balls(0);
  auto const plan = plan::make_plan(scene);
  ASSERT_TRUE(plan);
  auto const kept = render(scene, *plan, small());
  EXPECT_EQ(scene.objects.size(), 8u);
  auto const taken = render(std::move(scene), *plan, small());
  EXPECT_EQ(kept.image.rgb, taken.image.rgb);
}

TEST(TakenScene, StillTellsWhatABadSampleMet) {
  auto scene = row_of_balls(std::numeric_limits<double>::quiet_NaN());
  auto const plan = plan::make_plan(scene);
  ASSERT_TRUE(plan);
  auto const result = render(std::move(scene), *plan, small());
  ASSERT_TRUE(result.bad_sample);
  ASSERT_FALSE(result.bad_sample->path.empty());
  EXPECT_EQ(result.bad_sample->path.front().keyword, "sphere");
}

} // namespace
} // namespace abbe::render::testing
