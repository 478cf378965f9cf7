// SPDX-License-Identifier: MIT
#include "optics/band_hats.hpp"
#include "optics/comb.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace abbe::optics {
namespace {

using Jitter = Comb::Jitter;

std::vector<Bands> some_bands() {
  return {*Bands::uniform(1), *Bands::uniform(2),
          *Bands::uniform(8), *Bands::hall(16),
          *Bands::hall(3),    *Bands::from_edges({380, 400, 480, 490, 600, 780})};
}

TEST(BandHats, MassesSumToTheRange) {
  for (Bands const& bands : some_bands()) {
    BandHats const hats(bands);
    double sum = 0;
    for (int j = 0; j < bands.count(); ++j) sum += hats.mass(j);
    EXPECT_NEAR(sum, 400, 1e-12);
  }
  BandHats const uniform(*Bands::uniform(8));
  for (int j = 0; j < 8; ++j)
    EXPECT_NEAR(uniform.mass(j), 50, 1e-12); // ends included: research 1.3
}

TEST(BandHats, PartitionUnityAndInterpolateLinearly) {
  for (Bands const& bands : some_bands()) {
    BandHats const hats(bands);
    std::vector<double> const ones(static_cast<std::size_t>(bands.count()), 1.0);
    std::vector<double> const centers(bands.centers().begin(), bands.centers().end());
    for (double l = 380; l <= 780; l += 0.37) {
      EXPECT_NEAR(hats.gather(l, ones), 1, 2e-16);
      auto const s = hats.spread(l);
      EXPECT_GE(s.a, 0);
      EXPECT_LT(s.a, 1);
      double const inside = std::clamp(l, centers.front(), centers.back());
      EXPECT_NEAR(hats.gather(l, centers), inside, 1e-12 * l);
    }
  }
}

TEST(BandHats, ScatterKeepsTheEnergyOfEverySample) {
  for (Bands const& bands : some_bands()) {
    BandHats const hats(bands);
    for (double xi : {-0.5, -0.3, 0.0, 0.21, 0.4999, -1.7, 2.2}) {
      std::vector<double> values(static_cast<std::size_t>(bands.count()), 0.0);
      double given = 0, kept = 0;
      for (int i = 0; i < bands.count(); ++i) {
        double const radiance = 1 + 0.5 * std::sin(3.0 * i);
        double const l = hats.jittered(i, xi);
        ASSERT_TRUE(bands.contains(l));
        hats.scatter(i, l, radiance, values);
        given += bands.width(i) * radiance;
      }
      for (int j = 0; j < bands.count(); ++j)
        kept += hats.mass(j) * values[static_cast<std::size_t>(j)];
      EXPECT_NEAR(kept, given, 1e-13 * given);
    }
  }
}

TEST(BandHats, JitterWithinTheBandStaysInItAndIsLinear) {
  for (Bands const& bands : some_bands()) {
    BandHats const hats(bands);
    for (int i = 0; i < bands.count(); ++i) {
      EXPECT_EQ(hats.jittered(i, 0), bands.center(i));
      EXPECT_NEAR(hats.jittered(i, -0.5), bands.edge(i), 1e-12 * bands.edge(i));
      EXPECT_NEAR(hats.jittered(i, 0.25), bands.center(i) + 0.25 * bands.width(i), 1e-12 * 780);
    }
  }
}

/// E[P_j] = (1/w_j) integral of L phi_j, for uniform jitter of width 1 and 2 and the triangular
/// hat. The expectation over u is a midpoint sum with N points: error O(1/N^2) for the kinked
/// integrands.
TEST(BandHats, ScatterIsUnbiased) {
  auto const radiance = [](double l) { return 1 + 0.01 * (l - 380) + std::cos(l / 30); };
  for (Comb const& mode :
       {Comb{0, Jitter::Uniform, 1}, Comb{0, Jitter::Uniform, 2}, Comb{0, Jitter::Triangular, 2}})
    for (Bands const& bands : some_bands()) {
      // A jitter wider than the band reaches neighbours: even coverage needs equal widths, and room
      // for one reflection.
      if (mode.width > 1 && (!bands.is_uniform() || bands.count() < 2)) continue;
      BandHats const hats(bands);
      std::size_t const n = static_cast<std::size_t>(bands.count());
      std::vector<double> mean(n, 0.0), truth(n, 0.0);
      int const samples = 20000;
      for (int s = 0; s < samples; ++s)
        for (int i = 0; i < bands.count(); ++i) {
          double const l = hats.jittered(i, jitter_offset(mode, (s + 0.5) / samples));
          hats.scatter(i, l, radiance(l) / samples, mean);
        }
      int const steps = 400000;
      for (int s = 0; s < steps; ++s) {
        double const l = 380 + 400 * (s + 0.5) / steps;
        auto const spread = hats.spread(l);
        std::size_t const k = static_cast<std::size_t>(spread.lower);
        truth[k] += radiance(l) * (1 - spread.a) * 400 / steps;
        if (spread.a > 0) truth[k + 1] += radiance(l) * spread.a * 400 / steps;
      }
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_NEAR(mean[j], truth[j] / hats.mass(static_cast<int>(j)), 2e-5 * mean[j])
            << bands.count() << ' ' << j << ' ' << mode.width;
    }
}

TEST(JitterOffset, HasTheStatedDistribution) {
  Comb const hat{0, Jitter::Triangular, 2};
  EXPECT_DOUBLE_EQ(jitter_offset(hat, 0), -1);
  EXPECT_DOUBLE_EQ(jitter_offset(hat, 0.5), 0);
  EXPECT_DOUBLE_EQ(jitter_offset(hat, 0.125), -0.5); // the cdf of 1 - |x| at -1/2 is 1/8
  EXPECT_DOUBLE_EQ(jitter_offset({}, 0.25), -0.25);
}

} // namespace
} // namespace abbe::optics
