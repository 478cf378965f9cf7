// SPDX-License-Identifier: MIT
#include "transport/segments/absorption.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace abbe::transport {
namespace {

/// Light of 1 behind a way through a medium of two channels, the first of which it takes.
double left_of(double alpha, double distance) {
  std::uint16_t const channels[] = {0, 1};
  double light[] = {1, 1};
  Absorption({alpha, 0}).along({1, 2, channels, &distance, light, false});
  EXPECT_EQ(light[1], 1);
  return light[0];
}

TEST(Absorption, IsExpToTwoUnitsInTheLastPlace) {
  RandomKey const key(3);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    double const depth = std::ldexp(key.child(i).uniform(0), static_cast<int>(i % 40) - 30);
    if (depth > 700) continue;
    double const mine = left_of(1, depth);
    long double const exact = std::exp(-static_cast<long double>(depth));
    double const unit = std::nextafter(mine, 2.0) - mine;
    EXPECT_LE(std::fabs(static_cast<double>(exact - mine)), 2 * unit) << depth;
  }
}

TEST(Absorption, EndsAreExact) {
  EXPECT_EQ(left_of(0.5, 0), 1);
  EXPECT_EQ(left_of(0.5, std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(left_of(1, 1e300), 0);
  EXPECT_LE(left_of(1, 1e-300), 1);
}

TEST(Absorption, RaysTogetherHaveTheBitsOfOne) {
  RandomKey const key(4);
  for (std::size_t rays = 1; rays <= 700; rays += 99) {
    std::vector<double> distances(rays), light(rays), expected(rays);
    std::vector<std::uint16_t> const channels(rays, 0);
    for (std::size_t i = 0; i < rays; ++i) {
      distances[i] = i % 4 == 3 ? std::numeric_limits<double>::infinity()
                                : 30 * key.child(rays).uniform(static_cast<std::uint32_t>(i));
      light[i] = 0.5 + static_cast<double>(i);
      expected[i] = light[i] * left_of(1, distances[i]);
    }
    Absorption({1.0}).along({rays, 1, channels.data(), distances.data(), light.data(), false});
    EXPECT_EQ(light, expected);
  }
}

} // namespace
} // namespace abbe::transport
