// SPDX-License-Identifier: MIT
#include "wedge.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

using optics::Comb;

/// The wedge in grey, with paths that end late.
scene::Scene bars_behind(optics::GlassPtr glass, scene::DispersionMode const& mode, int bands) {
  auto scene = wedge(std::move(glass), mode, bands, Vec3(.9), Vec3(.2));
  scene.settings.adc_bailout = 1e-4;
  return scene;
}

struct Scheme {
  std::string name;
  scene::DispersionMode mode;
  int bands = 8;
};

class Unbiased : public ::testing::TestWithParam<Scheme> {};

/// The mean over seeds is the picture of many bands, at three standard errors of the whole
/// picture's red, green and blue, and it comes nearer as 1/sqrt(N).
TEST_P(Unbiased, MeanOverSeedsIsTheManyBandPicture) {
  auto options = small();
  auto const reference = picture(bars_behind(n_sf11(), deterministic(), 900), options);
  auto const scene = bars_behind(n_sf11(), GetParam().mode, GetParam().bands);
  std::size_t const n = reference.rgb.size();
  std::vector<double> sum(n), square(n), early(n);
  int const seeds = 192, few = 12;
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed) + 1;
    auto const image = picture(scene, options);
    for (std::size_t i = 0; i < n; ++i) {
      double const value = image.rgb[i];
      sum[i] += value;
      square[i] += value * value;
      if (seed < few) early[i] += value;
    }
  }
  // What the reference is off itself, by one with half its bands.
  auto const half = picture(bars_behind(n_sf11(), deterministic(), 450), options);
  double off_reference = 0, bias_of_reference[3] = {0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    double const off = double(half.rgb[i]) - double(reference.rgb[i]);
    off_reference += off * off;
    bias_of_reference[i % 3] += off;
  }
  double error_all = 0, error_few = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double bias = 0, variance = 0;
    for (std::size_t i = channel; i < n; i += 3) {
      double const mean = sum[i] / seeds;
      double const off = mean - double(reference.rgb[i]);
      bias += off;
      variance += std::max(0.0, square[i] / seeds - mean * mean) / seeds;
      error_all += off * off;
      error_few += std::pow(early[i] / few - double(reference.rgb[i]), 2);
    }
    EXPECT_GT(variance, 0) << "the scene shows too little dispersion to test anything";
    EXPECT_LT(std::abs(bias), 3 * std::sqrt(variance) + std::abs(bias_of_reference[channel]))
        << "channel " << channel;
  }
  // 16 times the seeds: an error of a quarter, two fifths at the outside.
  EXPECT_LT(std::sqrt(error_all), 0.4 * std::sqrt(error_few) + std::sqrt(off_reference));
}

std::vector<Scheme> schemes() {
  auto const comb = [](int teeth, Jitter jitter, Follow follow = Follow::Every, double width = 1) {
    return stochastic(Comb{teeth, jitter, width, follow});
  };
  return {{"low_discrepancy", comb(0, Jitter::LowDiscrepancy)},
          {"four_bands", comb(0, Jitter::LowDiscrepancy), 4},
          {"uniform", comb(0, Jitter::Uniform)},
          {"stratified", comb(0, Jitter::Stratified)},
          {"blue_noise", comb(0, Jitter::BlueNoise)},
          {"width_two", comb(0, Jitter::Uniform, Follow::Every, 2)},
          {"one_ray", comb(1, Jitter::LowDiscrepancy)},
          {"fewer_rays", comb(3, Jitter::LowDiscrepancy)},
          {"more_rays", comb(19, Jitter::LowDiscrepancy)},
          {"clusters_degraded", comb(4, Jitter::LowDiscrepancy, Follow::Importance)},
          {"hero", comb(4, Jitter::LowDiscrepancy, Follow::Hero)},
          {"clusters_of_sixteen", comb(16, Jitter::LowDiscrepancy, Follow::Importance)},
          {"hero_of_sixteen", comb(16, Jitter::LowDiscrepancy, Follow::Hero)},
          {"hero_blue", comb(6, Jitter::BlueNoise, Follow::Hero)}};
}

INSTANTIATE_TEST_SUITE_P(Schemes, Unbiased, ::testing::ValuesIn(schemes()),
                         [](auto const& instance) { return instance.param.name; });

double rms(image::Image const& a, image::Image const& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    square += std::pow(double(a.rgb[i]) - double(b.rgb[i]), 2);
  return std::sqrt(square / static_cast<double>(a.rgb.size()));
}

RenderResult render_mode(scene::Scene const& scene, RenderOptions const& options) {
  auto const plan = plan::make_plan(scene);
  ABBE_ASSERT(plan);
  return render(scene, *plan, options);
}

/// Without tolerance every band goes alone: the same bits. With some, fewer rays do, and what that
/// costs grows with the tolerance from nothing.
TEST(Adaptive, GoesFromTheDeterministicPictureToFewRays) {
  auto options = small();
  options.width = 80;
  options.height = 60;
  auto const exact = render_mode(bars_behind(n_sf11(), deterministic(), 48), options);
  auto const alone = render_mode(bars_behind(n_sf11(), adaptive(0), 48), options);
  EXPECT_EQ(alone.image.rgb, exact.image.rgb);
  EXPECT_EQ(alone.counts.monochromatic, exact.counts.monochromatic);
  auto const plain_glass = render_mode(bars_behind(n_sf11(), none(), 48), options);
  double const whole = rms(plain_glass.image, exact.image);
  double before = 0;
  auto rays = exact.counts.monochromatic;
  for (double const tolerance_px : {0.125, 0.5, 2.0}) {
    auto const some = render_mode(bars_behind(n_sf11(), adaptive(tolerance_px), 48), options);
    double const off = rms(some.image, exact.image);
    EXPECT_LT(some.counts.monochromatic, rays) << tolerance_px;
    EXPECT_GE(off, before) << tolerance_px;
    EXPECT_LT(off, 0.5 * whole) << tolerance_px;
    rays = some.counts.monochromatic;
    before = off;
  }
  auto const fine = render_mode(bars_behind(n_sf11(), adaptive(0.02), 48), options);
  EXPECT_LT(rms(fine.image, exact.image), 0.05 * whole);
}

/// One ray goes on where n did: rays after the split do not grow with the company.
TEST(Hero, FollowsOneRayASplit) {
  auto const options = small();
  for (int const company : {1, 4, 16}) {
    auto const mode = stochastic(Comb{company, Jitter::LowDiscrepancy, 1, Follow::Hero});
    auto const result = render_mode(bars_behind(n_sf11(), mode, 8), options);
    EXPECT_GT(result.counts.splits, 40u);
    EXPECT_LE(result.counts.monochromatic, result.counts.splits);
  }
}

/// A material of one comb behind a material of another, and a deterministic one behind both: light
/// keeps the wavelengths that it was first given, and white stays white.
TEST(Combs, MayBeMixedInAScene) {
  auto scene =
      bars_behind(n_sf11(), stochastic(Comb{5, Jitter::LowDiscrepancy, 1, Follow::Every}), 8);
  auto const slab = [&](double z, scene::DispersionMode const& mode) {
    auto const box = geometry::make_box({-3, -3, z}, {3, 3, z + 1});
    scene.objects.push_back(with_glass(object(box->shape, box->placement, clear()), n_bk7(), mode));
  };
  slab(10, stochastic(Comb{3, Jitter::Stratified, 1, Follow::Hero}));
  slab(12, deterministic());
  slab(14, faithful());
  slab(16, stochastic(Comb{0, Jitter::Triangular, 2, Follow::Every}));
  slab(18, adaptive(0.5));
  for (auto& object : scene.objects)
    if (object.texture && object.texture->front().finish->diffuse == 0 && !object.interior)
      object.texture->front().pigment.colour.rgb = Vec3(1);
  scene.background.rgb = Vec3(1);
  scene.settings.max_trace_level = 60;
  scene.settings.adc_bailout = 1e-7;
  auto const result = render_mode(scene, small());
  for (float const value : result.image.rgb) EXPECT_NEAR(value, 1, result.missing_most + 1e-5);
}

} // namespace
} // namespace abbe::render::testing
