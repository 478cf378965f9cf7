// SPDX-License-Identifier: MIT
#include "geometry/shapes/sphere.hpp"
#include "render/compile.hpp"
#include "scenes.hpp"
#include "transport/tracer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace abbe::render::testing {
namespace {

/// Balls in each other that mirror half of the light and let the other half pass: with each surface
/// that a path meets there are twice as many of them.
scene::Scene balls() {
  scene::Scene scene;
  for (int i = 0; i < 12; ++i) {
    auto layers = plain(Vec3(0.9), 0.5);
    layers[0].finish->diffuse = 0;
    scene::Reflection reflection;
    reflection.minimum.rgb = reflection.maximum.rgb = Vec3(0.5);
    layers[0].finish->reflection = reflection;
    auto const ball = geometry::make_sphere(Vec3(0.1 * i, 0.07 * (i % 5), 5 + 0.05 * i), 1);
    scene.objects.push_back(object(ball->shape, ball->placement, layers));
  }
  scene.background.rgb = Vec3(0.5);
  return scene;
}

struct Taken {
  std::uint32_t most = 0;    ///< rays of a sample
  std::uint32_t allowed = 0; ///< before more is asked of them
  double lost = 0;           ///< of the sample that lost most
};
Taken taken(scene::Scene const& scene) {
  auto const plan = plan::make_plan(scene, {});
  EXPECT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  transport::Tracer tracer(stage);
  tracer.count_rays();
  constexpr int size = 5;
  Taken out;
  out.allowed = stage.most_rays;
  for (int i = 0; i < size * size; ++i) {
    double const x = i % size + 0.5, y = i / size + 0.5;
    transport::SampleKey const key{RandomKey(1), 0, i % size, i / size, RandomKey(1)};
    tracer.trace({&x, &y, 1, size, size}, {&key, 1});
    out.most = std::max(out.most, tracer.rays_of(0));
    out.lost = std::max(out.lost, tracer.lost_of(0));
  }
  return out;
}

TEST(Endless, PathsThatPartAgainAndAgainComeToAnEnd) {
  Taken const usual = taken(balls());
  EXPECT_GT(usual.most, usual.allowed);
  EXPECT_LT(usual.most, 3 * usual.allowed);
  EXPECT_GT(usual.lost, 0);
}

TEST(Endless, PathsAreFollowedAsFarAsTheSceneSays) {
  auto scene = balls();
  scene.settings.adc_bailout = 1e-3;
  scene.settings.max_trace_level = 64;
  Taken const asked = taken(scene);
  EXPECT_EQ(asked.allowed, 0U);
  EXPECT_LE(asked.lost, 1.0);
  scene.settings.adc_bailout = 1e-4;
  EXPECT_GT(taken(scene).most, asked.most);
}

} // namespace
} // namespace abbe::render::testing
