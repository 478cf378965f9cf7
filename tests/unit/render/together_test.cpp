// SPDX-License-Identifier: MIT
#include "render/compile.hpp"
#include "table_scene.hpp"
#include "transport/tracer.hpp"

#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

using transport::SampleKey, transport::Tracer;

constexpr int size = 40;

/// Each sample has random numbers of its own.
SampleKey key_of(int x, int y) {
  auto const pixel = static_cast<std::uint64_t>(y * size + x);
  return {RandomKey(1).child(pixel), pixel % 7, x, y, RandomKey(1)};
}

/// Light, rays and losses of samples that are traced together, `width` pixels of a row or (0) as
/// many as a tracer takes, are those of each alone, bit for bit.
void expect_same(scene::Scene const& scene, std::size_t width) {
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  auto const footprint = stage.camera->footprint(size, size);
  Tracer alone(stage, footprint), together(stage, footprint);
  alone.count_rays();
  together.count_rays();
  auto const channels = stage.film_bands();
  std::vector<double> bands(channels), bands_together(channels), x, y;
  std::vector<SampleKey> keys;
  auto const take = [&] {
    together.trace({x.data(), y.data(), x.size(), size, size}, keys);
    for (std::size_t k = 0; k < x.size(); ++k) {
      alone.trace({&x[k], &y[k], 1, size, size}, {&keys[k], 1});
      ASSERT_EQ(together.light_of(k, bands_together), alone.light_of(0, bands))
          << x[k] << ' ' << y[k];
      ASSERT_EQ(bands_together, bands);
      ASSERT_EQ(together.lost_of(k), alone.lost_of(0));
      ASSERT_EQ(together.rays_of(k), alone.rays_of(0));
    }
  };
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      x.push_back(column + 0.5);
      y.push_back(row + 0.5);
      keys.push_back(key_of(column, row));
      if (x.size() == (width > 0 ? width : together.batch())) {
        ASSERT_NO_FATAL_FAILURE(take());
        x.clear();
        y.clear();
        keys.clear();
      }
    }
  if (!x.empty()) {
    ASSERT_NO_FATAL_FAILURE(take());
  }
  EXPECT_EQ(together.counts().total(), alone.counts().total());
  EXPECT_EQ(together.cut_light().paths, alone.cut_light().paths);
  EXPECT_EQ(together.cut_light().sum, alone.cut_light().sum);
  EXPECT_EQ(together.cut_light().worst_sample, alone.cut_light().worst_sample);
}

TEST(Together, SamplesOfRgbAreThoseOfEachAlone) {
  for (std::size_t const width : {0, 200, 32, 5, 2}) expect_same(table(none(), false), width);
}
TEST(Together, SamplesOfBandsAreThoseOfEachAlone) {
  for (std::size_t const width : {0, 200, 13, 3}) expect_same(table(deterministic(), true), width);
}
TEST(Together, SamplesThatSplitAdaptivelyAreThoseOfEachAlone) {
  for (std::size_t const width : {0, 16, 3}) expect_same(table(adaptive(0.5), true), width);
}
TEST(Together, SamplesWithWavelengthsOfTheirOwnAreThoseOfEachAlone) {
  for (Follow const follow : {Follow::Every, Follow::Hero, Follow::Importance, Follow::Doubled})
    for (int const teeth : {0, 1, 3, 20})
      if (follow != Follow::Doubled || teeth == 0)
        expect_same(table(stochastic({teeth, Jitter::LowDiscrepancy, 1, follow}), true), 0);
  for (auto const& comb : {optics::Comb{0, Jitter::Stratified, 1, Follow::Every},
                           optics::Comb{0, Jitter::BlueNoise, 1, Follow::Hero},
                           optics::Comb{0, Jitter::Triangular, 2, Follow::Every}})
    for (std::size_t const width : {0, 16, 3}) expect_same(table(stochastic(comb), true), width);
}
TEST(Together, GlassThatMirrorsByItsFinishIsThatOfEachAlone) {
  for (double const exponent : {1.0, 0.5}) {
    auto scene = table(stochastic(), true);
    scene::Reflection reflection;
    reflection.maximum.rgb = Vec3(0.3);
    reflection.exponent = exponent;
    ASSERT_TRUE(scene.objects[1].texture);
    scene.objects[1].texture->at(0).finish->reflection = reflection;
    expect_same(scene, 0);
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
    for (std::size_t const width : {0, 7}) expect_same(scene, width);
  }
}
/// Places of areas that are drawn by lot, in fog that lamps go through, behind glass.
TEST(Together, AreaLightsInFogAreThoseOfEachAlone) {
  for (auto const& mode : {none(), deterministic(), stochastic()}) {
    auto scene = table(mode, mode.kind != scene::DispersionMode::Kind::None);
    ASSERT_FALSE(scene.lights.empty());
    for (int const adaptive : {0, 100}) {
      scene::AreaGrid area{{3, 0, 0}, {0, 0, 2}, 5, 3, adaptive, true};
      area.illumination = adaptive == 0;
      scene.lights.front().area = area;
      scene.lights.front().media_attenuation = true;
      scene.fogs.assign(2, {});
      scene.fogs[0].distance = 9;
      scene.fogs[0].colour = {{0.5, 0.4, 0.6}, 0.2, 0.1, nullptr};
      scene.fogs[1].distance = 5;
      scene.fogs[1].ground = true;
      scene.fogs[1].alt = 0.7;
      scene.fogs[1].turbulence.emplace().amount = Vec3(0.5);
      for (std::size_t const width : {0, 7}) expect_same(scene, width);
    }
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
      vessel.children =
          std::vector{box({-1.2, -1.1, 3}, {1.2, 1, 5}), box({-1, -0.9, 3.2}, {1, 2, 4.8})};
      scene.objects.push_back(with_glass(vessel, n_sf11(), mode));
      Vec3 const short_of(gap);
      scene.objects.push_back(with_glass(
          box(Vec3(-1, -0.9, 3.2) + short_of, Vec3(1, 0.4, 4.8) - short_of), n_bk7(), mode));
      for (std::size_t const width : {0, 7}) expect_same(scene, width);
    }
}
TEST(Together, SolidsThatDisplaceEachOtherAreThoseOfEachAlone) {
  auto scene = table(stochastic(), true);
  auto other = *scene.objects[1].interior;
  other.priority = 1;
  scene.objects[1].interior = std::make_shared<scene::Interior>(other);
  for (std::size_t const width : {0, 7}) expect_same(scene, width);
}
/// Mirrors face to face: so many rays that some samples wait for others.
TEST(Together, SamplesThatWaitAreThoseOfEachAlone) {
  auto scene = table(deterministic(), true);
  for (auto& object : scene.objects) {
    scene::Reflection reflection;
    reflection.maximum.rgb = reflection.minimum.rgb = Vec3(0.9);
    if (object.texture) object.texture->at(0).finish->reflection = reflection;
  }
  expect_same(scene, 0);
}

} // namespace
} // namespace abbe::render::testing
