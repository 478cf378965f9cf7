// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

/// A solid of glass in a uniform white surround renders as the surround: what is reflected and what
/// is passed add up to all of it, at every wavelength, through any number of internal reflections.
scene::Scene furnace(geometry::ShapePtr shape, optics::GlassPtr glass, scene::DispersionMode mode,
                     int bands) {
  scene::Scene scene;
  auto const placement =
      geometry::Transform::rotation({20, 30, 10}).then(geometry::Transform::translation({0, 0, 4}));
  scene.objects.push_back(
      with_glass(object(std::move(shape), placement, clear()), std::move(glass), mode));
  scene.background.rgb = Vec3(1);
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = bands;
  scene.settings.max_trace_level = 50;
  scene.settings.adc_bailout = 0;
  return scene;
}

struct Case {
  std::string name;
  scene::DispersionMode mode;
  int bands;
};

class Furnace : public ::testing::TestWithParam<Case> {};

/// The result of a furnace; each pixel and band white but for what the file says is missing. The
/// rounding of up to 50 interfaces and 1000 bands, and of the picture's floats, stays below 1e-6.
void expect_white(scene::Scene const& scene, int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.spectral_output = true;
  auto const plan = plan::make_plan(scene);
  ASSERT_TRUE(plan);
  auto const result = render(scene, *plan, options);
  double const most = result.missing_most + 1e-6;
  double sum = 0;
  for (float const value : result.image.rgb) {
    ASSERT_NEAR(value, 1, most);
    sum += value;
  }
  EXPECT_NEAR(sum / static_cast<double>(result.image.rgb.size()), 1, result.missing_mean + 1e-6);
}

TEST_P(Furnace, GlassInWhiteIsWhite) {
  for (auto const& shape : {geometry::ShapePtr(std::make_shared<geometry::Sphere>()),
                            geometry::ShapePtr(std::make_shared<geometry::Box>())})
    expect_white(furnace(shape, n_sf11(), GetParam().mode, GetParam().bands),
                 GetParam().bands > 100 ? 6 : 24);
}

std::vector<Case> cases() {
  std::vector<Case> out;
  for (int const bands : {1, 2, 3, 8, 45, 450, 1000}) {
    auto const add = [&](std::string const& name, scene::DispersionMode const& mode) {
      out.push_back({name + std::to_string(bands), mode, bands});
    };
    add("none", none());
    add("deterministic", deterministic());
    add("stochastic", stochastic());
    add("triangular", triangular());
    add("faithful", faithful());
    if (bands > 45) continue;
    using optics::Comb;
    add("adaptive", adaptive(0.5));
    add("rays", stochastic(Comb{5, Jitter::LowDiscrepancy, 1, Follow::Every}));
    add("stratified", stochastic(Comb{0, Jitter::Stratified, 1, Follow::Every}));
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Modes, Furnace, ::testing::ValuesIn(cases()),
                         [](auto const& instance) { return instance.param.name; });

/// Where one tooth is picked for what passes, and all are mirrored, white is exact on the mean
/// only: the picked tooth's reflectance is not the mean of all.
TEST(FurnaceOfPicks, IsWhiteOnTheMean) {
  using optics::Comb;
  for (auto const follow : {Follow::Hero, Follow::Importance}) {
    auto const scene = furnace(std::make_shared<geometry::Sphere>(), n_sf11(),
                               stochastic(Comb{4, Jitter::LowDiscrepancy, 1, follow}), 8);
    auto const plan = plan::make_plan(scene);
    ASSERT_TRUE(plan);
    RenderOptions options;
    options.width = options.height = 12;
    double sum = 0, square = 0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
      options.seed = seed;
      auto const image = render(scene, *plan, options).image;
      for (std::size_t i = 1; i < image.rgb.size(); i += 3) { // green: near luminance
        double const off = double(image.rgb[i]) - 1;
        EXPECT_LT(std::abs(off), 0.05);
        sum += off;
        square += off * off;
        ++count;
      }
    }
    EXPECT_GT(square, 0);
    EXPECT_LT(std::abs(sum), 3 * std::sqrt(square) + 1e-6 * count);
  }
}

/// The film of the bands keeps the energy too, each band that of its white.
TEST(FurnaceSpectrum, EachBandIsWhite) {
  for (int const bands : {1, 2, 3, 16})
    for (auto const& mode : {none(), deterministic(), stochastic(), triangular()}) {
      auto const scene = furnace(std::make_shared<geometry::Sphere>(), n_sf11(), mode, bands);
      RenderOptions options;
      options.width = options.height = 12;
      options.spectral_output = true;
      auto const plan = plan::make_plan(scene);
      ASSERT_TRUE(plan);
      auto const image = render(scene, *plan, options).image;
      auto const n = static_cast<std::size_t>(bands);
      // The corner of the picture passes the glass by.
      for (std::size_t i = 0; i < image.bands.size(); ++i)
        ASSERT_NEAR(image.bands[i] / image.bands[i % n], 1, 1e-5) << bands;
    }
}

} // namespace
} // namespace abbe::render::testing
