// SPDX-License-Identifier: MIT
#include "wedge.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

struct Statistics {
  std::vector<double> sum, square;
  int count = 0;
  void add(std::vector<float> const& values) {
    sum.resize(values.size());
    square.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      square[i] += double(values[i]) * double(values[i]);
    }
    ++count;
  }
  double mean(std::size_t i) const { return sum[i] / count; }
  double standard_error(std::size_t i) const {
    double const variance = std::max(0.0, square[i] / count - mean(i) * mean(i));
    return std::sqrt(variance / count);
  }
};

/// The mean of the stochastic mode over seeds is the picture of 450 bands: without bias at three
/// standard errors in each channel, its error falling as 1/sqrt(N).
TEST(Stochastic, MeanOverSeedsIsTheManyBandPicture) {
  auto options = small();
  auto const reference = picture(wedge(n_sf11(), deterministic(), 450), options);
  Statistics all, first;
  int const seeds = 256, early = 16;
  auto const scene = wedge(n_sf11(), stochastic(), 8);
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed) + 1;
    auto const image = picture(scene, options);
    all.add(image.rgb);
    if (seed < early) first.add(image.rgb);
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double bias = 0, variance = 0, error_all = 0, error_first = 0;
    int noisy = 0;
    for (std::size_t i = channel; i < reference.rgb.size(); i += 3) {
      double const off = all.mean(i) - reference.rgb[i];
      double const off_first = first.mean(i) - reference.rgb[i];
      bias += off;
      variance += all.standard_error(i) * all.standard_error(i);
      error_all += off * off;
      error_first += off_first * off_first;
      if (all.standard_error(i) > 1e-4) ++noisy;
    }
    ASSERT_GT(noisy, 40) << "the scene shows too little dispersion to test anything";
    EXPECT_LT(std::abs(bias), 3 * std::sqrt(variance)) << "channel " << channel;
    // 16 times the seeds: an error of a quarter, a third at the outside.
    EXPECT_LT(std::sqrt(error_all), std::sqrt(error_first) / 3) << "channel " << channel;
  }
}

TEST(Stochastic, SeedsDifferOnlyWhereStochasticGlassIsSeen) {
  auto options = small();
  auto scene = wedge(n_sf11(), stochastic(), 8);
  auto const a = picture(scene, options);
  options.seed = 7;
  auto const b = picture(scene, options);
  // The same without glass tells where it is not seen.
  scene.objects.erase(scene.objects.begin());
  auto const bare = picture(scene, options);
  int differing = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    bool const differs =
        a.rgb[i] != b.rgb[i] || a.rgb[i + 1] != b.rgb[i + 1] || a.rgb[i + 2] != b.rgb[i + 2];
    if (differs) ++differing;
  }
  EXPECT_GT(differing, 20);
  // Corners of the picture pass the glass by.
  for (std::size_t x : {std::size_t{0}, std::size_t{19}})
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(a.rgb[3 * x + c], bare.rgb[3 * x + c]);
  // A deterministic scene does not know of seeds at all.
  auto const fixed = wedge(n_sf11(), deterministic(), 8);
  options.seed = 1;
  auto const c = picture(fixed, options);
  options.seed = 2;
  EXPECT_EQ(c.rgb, picture(fixed, options).rgb);
}

/// Dispersion going to nothing goes to the picture without dispersion, in every mode, without a
/// jump and without a tint (LuxCore issue 589).
TEST(DispersionLimit, VanishingDispersionIsNoDispersion) {
  double const nd = 1.6;
  auto const glass_of = [&](double nf_minus_nc) {
    auto glass = optics::GlassBuilder("limit").abbe(nd, (nd - 1) / nf_minus_nc).build();
    ABBE_ASSERT(glass);
    return *glass;
  };
  auto const options = small();
  auto const rms = [](std::vector<float> const& a, std::vector<float> const& b) {
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(double(a[i]) - double(b[i]), 2);
    return std::sqrt(square / static_cast<double>(a.size()));
  };
  for (int const bands : {1, 3, 8})
    for (Vec3 const& wall : {Vec3(1), Vec3(.9, .35, .1)}) {
      auto const plain_image = picture(wedge(glass_of(1e-2), none(), bands, wall), options);
      int number = 0;
      using optics::Comb;
      for (auto const& mode :
           {deterministic(), stochastic(), triangular(), faithful(), adaptive(0.5),
            stochastic(Comb{3, Jitter::LowDiscrepancy, 1, Follow::Every}),
            stochastic(Comb{0, Jitter::Stratified, 1, Follow::Every}),
            stochastic(Comb{4, Jitter::BlueNoise, 1, Follow::Hero}),
            stochastic(Comb{4, Jitter::LowDiscrepancy, 1, Follow::Importance})}) {
        SCOPED_TRACE("mode " + std::to_string(number++) + ", bands " + std::to_string(bands));
        double before = 1;
        for (double spread = 1e-2; spread > 0.9e-12; spread /= 100) {
          auto const image = picture(wedge(glass_of(spread), mode, bands, wall), options);
          double const off = rms(image.rgb, plain_image.rgb);
          EXPECT_LE(off, before + 1e-6);
          // Dispersion x 1e-6: in one sample a pixel, not only on the mean (research brief 7.2).
          if (spread < 1.1e-8) {
            EXPECT_LT(off, 1e-6) << spread;
          }
          before = off;
        }
      }
    }
}

TEST(Determinism, ThreadsAndTilesDoNotMatter) {
  auto const scene = wedge(n_sf11(), stochastic(), 8);
  auto options = small();
  options.anti_aliasing.method = 1;
  options.threads = 1;
  options.spectral_output = true;
  auto const one = picture(scene, options);
  for (int const threads : {2, 7})
    for (int const tile : {1, 5, 64}) {
      options.threads = threads;
      options.tile_size = tile;
      auto const other = picture(scene, options);
      EXPECT_EQ(one.rgb, other.rgb) << threads << " threads, tiles of " << tile;
      EXPECT_EQ(one.bands, other.bands);
    }
}

TEST(Determinism, ARegionIsAPartOfThePicture) {
  auto const scene = wedge(n_sf11(), stochastic(), 8);
  auto options = small();
  auto const whole = picture(scene, options);
  options.region = Region{5, 3, 17, 14};
  auto const part = picture(scene, options);
  for (int y = 3; y < 14; ++y)
    for (int x = 5; x < 17; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(part.rgb[static_cast<std::size_t>(3 * ((y - 3) * 12 + x - 5) + c)],
                  whole.rgb[static_cast<std::size_t>(3 * (y * 20 + x) + c)]);
}

} // namespace
} // namespace abbe::render::testing
