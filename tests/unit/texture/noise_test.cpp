// SPDX-License-Identifier: MIT
#include "texture/noise_bounds.hpp"
#include "texture/noise_tables.hpp"
#include "texture/pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace abbe::texture {
namespace {

Vec3 const p(0.3, 0.7, 1.9);
// What POV-Ray 3.7 prints, 12 decimals (section 22 of the language notes).
constexpr double printed = 1e-12;

TEST(NoiseTables, HoldTheDocumentedEntries) {
  auto const& g = noise_tables().gradient;
  EXPECT_EQ(g[0], -1);
  EXPECT_EQ(g[1], 0.604974);
  EXPECT_EQ(g[2], -0.937102);
  EXPECT_EQ(g[266], 0.566186);
}

TEST(NoiseTables, HashIsAPermutationTwice) {
  std::vector<int> count(4096);
  for (int i = 0; i < 4096; ++i) {
    ++count[noise_tables().hash[i]];
    EXPECT_EQ(noise_tables().hash[i], noise_tables().hash[4096 + i]);
  }
  for (int c : count) EXPECT_EQ(c, 1);
}

TEST(Noise, MatchesPovrayForEveryGenerator) {
  EXPECT_NEAR(noise(p, 2), 0.367178081198, printed);
  EXPECT_NEAR(noise(p, 1), 0.197143578111, printed);
  EXPECT_NEAR(noise(p, 3), 0.525083673039, printed);
  EXPECT_NEAR(noise(Vec3(-3.3, 0.7, -1.9), 1), 0.446670434940, printed);
}

TEST(Noise, DefaultsToGeneratorTwo) {
  EXPECT_EQ(noise(p), noise(p, 2));
}

TEST(VectorTurbulence, MatchesPovray) {
  Vec3 const v = vector_turbulence(p, {Vec3(0), 6, 0.5, 2});
  EXPECT_NEAR(v.x, -0.316815465311, printed);
  EXPECT_NEAR(v.y, -0.473952815161, printed);
  EXPECT_NEAR(v.z, -0.150192997106, printed);
}

TEST(VectorTurbulence, OfOneOctaveIsVectorNoise) {
  EXPECT_EQ(vector_turbulence(p, {Vec3(0), 1, 0.5, 2}), vector_noise(p));
}

// Noise and its derivatives vanish nowhere by chance: continuity across the lattice is what a wrong
// cell would break. The slope of noise is below 4, so a step of 1e-9 changes it by less than 1e-8.
TEST(Noise, IsContinuousAcrossCells) {
  for (int generator = 1; generator <= 3; ++generator)
    for (int cell = -5; cell <= 5; ++cell)
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 below(0.37, -1.41, 2.83), above = below;
        double const border = generator == 3 ? cell - 0.023157213 : cell;
        below[axis] = border - 1e-9;
        above[axis] = border + 1e-9;
        EXPECT_NEAR(noise(below, generator), noise(above, generator), 1e-8);
      }
}

TEST(Noise, RepeatsEvery4096Cells) {
  Vec3 const q(0.25, 0.5, 0.75);
  EXPECT_EQ(noise(q), noise(q + Vec3(4096, -8192, 4096)));
  // Far beyond the range of int, where 2^k is still a multiple of 4096.
  double const far = 0x1p40;
  EXPECT_EQ(noise(q), noise(q + Vec3(far, far, far)));
}

TEST(Noise, IsDefinedAndBoundedForEveryDouble) {
  double const inf = std::numeric_limits<double>::infinity();
  for (double v : {1e300, -1e300, 0x1p30, -0x1p30, 0x1p31, 5e-324, inf, -inf, std::nan("")})
    for (int generator = 1; generator <= 2; ++generator) {
      double const n = noise(Vec3(v, 0.3, -v), generator);
      EXPECT_GE(n, 0) << v;
      EXPECT_LE(n, 1) << v;
    }
}

/// Boxes of all sizes, in one cell of the lattice and over several.
TEST(Noise, BoundsHoldValuesAndGradientsOfABox) {
  std::mt19937 engine(7);
  auto const number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int generator = 1; generator <= 3; ++generator) {
    for (int round = 0; round < 2000; ++round) {
      Vec3 const middle(number(-3, 3), number(-3, 3), number(-3, 3));
      Vec3 const reach = std::exp2(-number(0, 12)) * Vec3(number(0, 1), number(0, 1), number(0, 1));
      NoiseBounds const box = noise_about(middle, reach, generator);
      EXPECT_NEAR(box.at, noise(middle, generator), 1e-14);
      for (int k = 0; k < 8; ++k) {
        Vec3 const at = middle + reach * Vec3(number(-1, 1), number(-1, 1), number(-1, 1));
        double const value = noise(at, generator);
        EXPECT_LE(box.value.low, value);
        EXPECT_GE(box.value.high, value);
        for (int axis = 0; axis < 3; ++axis) {
          Vec3 step(0);
          step[axis] = 1e-6;
          double const slope = (noise(at + step, generator) - noise(at - step, generator)) / 2e-6;
          EXPECT_LE(box.gradient[axis].low, slope + 1e-4);
          EXPECT_GE(box.gradient[axis].high, slope - 1e-4);
        }
      }
    }
  }
}

TEST(Noise, BoundsShrinkWithTheBox) {
  for (int generator = 1; generator <= 3; ++generator)
    for (double const reach : {1e-2, 1e-3, 1e-4}) {
      NoiseBounds const box = noise_about(p, Vec3(reach), generator);
      for (Interval const& g : box.gradient) EXPECT_LT(g.width(), 200 * reach) << generator;
    }
}

} // namespace
} // namespace abbe::texture
