// SPDX-License-Identifier: MIT
#include "optics/basis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

using Light = std::vector<double>;

Light smooth(Bands const& grid, double a, double b, double c) {
  Light out;
  for (double const l : grid.centers()) {
    double const x = (l - 580) / 200;
    out.push_back(1 + a * x + b * x * x + c * std::sin(4 * x));
  }
  return out;
}

Vec3 colour(ChannelSet const& channels, Light const& light) {
  auto const values = channels.from_bands(light);
  Vec3 sum(0);
  for (int c = 0; c < channels.count(); ++c)
    sum += channels.rgb_weight(c) * values[static_cast<std::size_t>(c)];
  return sum;
}

/// A family of four directions (white and three shapes) needs four channels, and then any mixture
/// of it has its own colour.
TEST(Basis, IsExactForTheFamilysSpan) {
  auto const grid = *Bands::uniform(200);
  std::vector<Light> family;
  for (double const a : {-.6, -.2, .3, .7})
    for (double const b : {-.4, .1, .5})
      for (double const c : {-.3, .2}) family.push_back(smooth(grid, a, b, c));
  auto const basis = choose_basis(grid, family, 12, false);
  EXPECT_EQ(basis.count(), 4);
  for (auto const& light :
       {smooth(grid, .13, -.31, .07), smooth(grid, -.5, .2, .4), smooth(grid, 2, 1, -1)}) {
    Vec3 const off = colour(basis, light) - grid.rgb(light);
    EXPECT_LT(glm::length(off), 1e-10);
  }
}

TEST(Basis, WhiteIsWhiteInAnySize) {
  auto const grid = *Bands::uniform(120, 400, 700);
  std::vector<Light> family;
  for (double const a : {-.6, .1, .7}) family.push_back(smooth(grid, a, a * a, .5 * a));
  for (int const size : {1, 2, 3, 4}) {
    auto const basis = choose_basis(grid, family, size, false);
    Vec3 const white = colour(basis, Light(120, 1.0));
    EXPECT_NEAR(white.x, 1, 1e-12);
    EXPECT_NEAR(white.y, 1, 1e-12);
    EXPECT_NEAR(white.z, 1, 1e-12);
  }
}

/// More channels, less error, for a family that no few directions span.
TEST(Basis, ComesNearerWithItsSize) {
  auto const grid = *Bands::uniform(200);
  std::vector<Light> family;
  for (double peak = 400; peak < 770; peak += 12) {
    Light light;
    for (double const l : grid.centers()) light.push_back(std::exp(-std::pow((l - peak) / 30, 2)));
    family.push_back(light);
  }
  double before = 1e9;
  for (int const size : {3, 6, 12, 24}) {
    auto const basis = choose_basis(grid, family, size, false);
    EXPECT_EQ(basis.count(), size);
    double worst = 0;
    for (auto const& light : family)
      worst = std::max(worst, glm::length(colour(basis, light) - grid.rgb(light)));
    EXPECT_LT(worst, before);
    before = worst;
  }
  EXPECT_LT(before, 1e-4);
}

/// With light that is parted, as many channels as bands are the bands: to the rounding of a
/// decomposition of 200 x 200 (1e-16 by a condition below 1e3, weights up to 0.1).
TEST(Basis, OfAllBandsIsTheBandsWhereLightIsParted) {
  auto const grid = *Bands::uniform(200);
  std::vector<Light> family;
  for (double const a : {-.6, .1, .7}) family.push_back(smooth(grid, a, a * a, .5 * a));
  auto const basis = choose_basis(grid, family, 200, true);
  ASSERT_EQ(basis.count(), 200);
  for (int b = 0; b < 200; ++b)
    EXPECT_LT(glm::length(basis.rgb_weight(b) - grid.rgb_weight(b)), 1e-12) << b;
  EXPECT_EQ(choose_basis(grid, family, 200, false).count(),
            3); // a x + a^2 x^2 + a sin: no more than two, and white
}

/// A part of white below an edge anywhere: half the error for twice the channels, on the mean over
/// the edges, with a margin of a quarter.
TEST(Basis, OfPartedLightComesNearerWithItsSize) {
  auto const grid = *Bands::uniform(200);
  double before = 0;
  for (int const size : {4, 8, 16, 32, 64}) {
    auto const basis = choose_basis(grid, {}, size, true);
    double square = 0;
    for (std::size_t edge = 1; edge < 200; ++edge) {
      Light light(200, 0.0);
      std::fill_n(light.begin(), edge, 1.0);
      Vec3 const off = colour(basis, light) - grid.rgb(light);
      square += glm::dot(off, off);
    }
    double const error = std::sqrt(square / 199);
    if (before > 0) {
      EXPECT_LT(error, 0.625 * before) << size;
    }
    before = error;
  }
}

} // namespace
} // namespace abbe::optics
