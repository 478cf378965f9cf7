// SPDX-License-Identifier: MIT
#include "render/camera.hpp"
#include "table_scene.hpp"

#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

constexpr int size = 40;

geometry::Ray ray_of(Stage const& stage, int x, int y) {
  return camera_ray(stage.camera, x + 0.5, y + 0.5, size, size);
}

/// Each sample has random numbers of its own.
SampleKey key_of(int x, int y) {
  auto const pixel = static_cast<std::uint64_t>(y * size + x);
  return {RandomKey(1).child(pixel), pixel % 7, x, y, RandomKey(1)};
}

/// Light, rays and losses of samples that are traced together, in groups of `width`, are those of
/// each alone, bit for bit.
void expect_same(scene::Scene const& scene, std::size_t width) {
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  Footprint const footprint = pixel_footprint(stage.camera, size, size);
  Tracer alone(stage, footprint), together(stage, footprint);
  ASSERT_TRUE(together.together());
  auto const channels = static_cast<std::size_t>(stage.channels);
  std::vector<double> bands(channels), bands_together(channels);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x + static_cast<int>(width) <= size; x += static_cast<int>(width)) {
      geometry::FanLines rays;
      std::vector<SampleKey> keys;
      rays.count = width;
      for (std::size_t k = 0; k < width; ++k) {
        auto const ray = ray_of(stage, x + static_cast<int>(k), y);
        rays.origin.set(k, ray.origin);
        rays.direction.set(k, ray.direction);
        rays.origin_error.set(k, ray.origin_error);
        keys.push_back(key_of(x + static_cast<int>(k), y));
      }
      rays.fill();
      together.samples(rays, keys);
      for (std::size_t k = 0; k < width; ++k) {
        Vec3 const one = alone.sample(ray_of(stage, x + static_cast<int>(k), y), keys[k], bands);
        ASSERT_EQ(together.light_of(k, bands_together), one) << x << ' ' << y << ' ' << k;
        ASSERT_EQ(bands_together, bands);
      }
    }
  }
  EXPECT_EQ(together.counts().total(), alone.counts().total());
  EXPECT_EQ(together.cut_light().paths, alone.cut_light().paths);
  EXPECT_EQ(together.cut_light().sum, alone.cut_light().sum);
  EXPECT_EQ(together.cut_light().worst_sample, alone.cut_light().worst_sample);
}

TEST(Together, SamplesOfRgbAreThoseOfEachAlone) {
  for (std::size_t const width : {32, 20, 8, 5, 2}) expect_same(table(none(), false), width);
}
TEST(Together, SamplesOfBandsAreThoseOfEachAlone) {
  for (std::size_t const width : {32, 20, 13, 3}) expect_same(table(deterministic(), true), width);
}
TEST(Together, SamplesThatSplitAdaptivelyAreThoseOfEachAlone) {
  for (std::size_t const width : {16, 3}) expect_same(table(adaptive(0.5), true), width);
}
TEST(Together, SamplesWithWavelengthsOfTheirOwnAreThoseOfEachAlone) {
  for (Follow const follow : {Follow::Every, Follow::Hero, Follow::Importance, Follow::Doubled})
    for (int const teeth : {0, 1, 3, 20})
      if (follow != Follow::Doubled || teeth == 0)
        expect_same(table(stochastic({teeth, Jitter::LowDiscrepancy, 1, follow}), true), 16);
  for (auto const& comb : {optics::Comb{0, Jitter::Stratified, 1, Follow::Every},
                           optics::Comb{0, Jitter::BlueNoise, 1, Follow::Hero},
                           optics::Comb{0, Jitter::Triangular, 2, Follow::Every}})
    for (std::size_t const width : {16, 3}) expect_same(table(stochastic(comb), true), width);
}
TEST(Together, GlassThatMirrorsByItsFinishIsThatOfEachAlone) {
  for (double const exponent : {1.0, 0.5}) {
    auto scene = table(stochastic(), true);
    scene::Reflection reflection;
    reflection.maximum.rgb = Vec3(0.3);
    reflection.exponent = exponent;
    ASSERT_TRUE(scene.objects[1].texture);
    scene.objects[1].texture->at(0).finish->reflection = reflection;
    expect_same(scene, 16);
  }
}
/// Balls in each other and beside each other, with colours, and media that fade.
TEST(Together, ShadowsBehindSeveralFiltersAreThoseOfEachAlone) {
  for (bool const spectral : {false, true}) {
    auto scene = table(spectral ? deterministic() : none(), spectral);
    scene.objects.resize(1); // the floor
    auto const add = [&](Vec3 const& centre, double radius, scene::Colour const& colour,
                         double fade) {
      auto const ball = geometry::make_sphere(centre, radius);
      auto layers = clear();
      layers[0].pigment.colour = colour;
      auto made = object(ball->shape, ball->placement, layers);
      auto interior = std::make_shared<scene::Interior>();
      interior->ior = 1.2;
      interior->fade_distance = fade;
      interior->fade_power = fade > 0 ? 2 : 0;
      made.interior = interior;
      scene.objects.push_back(made);
    };
    add({-0.6, 0.64, 2.4}, 0.5, {{1, 0.5, 0.2}, 0.9, 0, nullptr}, 0.5);
    add({-0.6, 0.64, 2.4}, 0.25, {{0.2, 0.9, 0.6}, 0.6, 0.2, nullptr}, 0);
    add({-0.2, -0.4, 3}, 0.4, {{0.4, 0.4, 1}, 0.7, 0.1, nullptr}, 0.3);
    for (std::size_t const width : {32, 7}) expect_same(scene, width);
  }
}
/// Water in a vessel of glass: it has its wall in common with it, or is just short of it.
TEST(Together, MediaThatTouchAreThoseOfEachAlone) {
  for (double const gap : {0.0, 1e-7})
    for (auto const& mode : {none(), deterministic(), stochastic(), adaptive(0.5)}) {
      auto scene = table(mode, mode.kind != scene::DispersionMode::Kind::None);
      scene.objects.resize(1); // the floor
      auto const box = [](Vec3 const& low, Vec3 const& high) {
        auto const made = geometry::make_box(low, high);
        return object(made->shape, made->placement, clear());
      };
      scene::Object vessel;
      vessel.kind = scene::Object::Kind::Difference;
      vessel.children = {box({-1.2, -1.1, 3}, {1.2, 1, 5}), box({-1, -0.9, 3.2}, {1, 2, 4.8})};
      scene.objects.push_back(with_glass(vessel, n_sf11(), mode));
      Vec3 const short_of(gap);
      scene.objects.push_back(with_glass(
          box(Vec3(-1, -0.9, 3.2) + short_of, Vec3(1, 0.4, 4.8) - short_of), n_bk7(), mode));
      for (std::size_t const width : {32, 7}) expect_same(scene, width);
    }
}
TEST(Together, NotWhereSolidsDisplaceEachOther) {
  auto scene = table(stochastic(), true);
  auto other = *scene.objects[1].interior;
  other.priority = 1;
  scene.objects[1].interior = std::make_shared<scene::Interior>(other);
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  EXPECT_FALSE(Tracer(stage).together());
}

} // namespace
} // namespace abbe::render::testing
