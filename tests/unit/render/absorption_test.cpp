// SPDX-License-Identifier: MIT
#include "render/absorption.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace abbe::render {
namespace {

TEST(Absorption, IsExpToTwoUnitsInTheLastPlace) {
  RandomKey const key(3);
  for (std::uint64_t i = 0; i < 200000; ++i) {
    double const depth = std::ldexp(key.child(i).uniform(0), static_cast<int>(i % 40) - 30);
    if (depth > 700) continue;
    double const mine = transmittance(depth);
    long double const exact = std::exp(-static_cast<long double>(depth));
    double const unit = std::nextafter(mine, 2.0) - mine;
    EXPECT_LE(std::fabs(static_cast<double>(exact - mine)), 2 * unit) << depth;
  }
}

TEST(Absorption, EndsAreExact) {
  EXPECT_EQ(transmittance(0), 1);
  EXPECT_EQ(transmittance(std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(transmittance(1e300), 0);
  EXPECT_LE(transmittance(1e-300), 1);
}

TEST(Absorption, LanesHaveTheBitsOfOne) {
  RandomKey const key(4);
  for (std::size_t count = 1; count <= 9; ++count) {
    std::vector<double> depths(12), values(count), expected(count);
    for (std::size_t i = 0; i < count; ++i) {
      depths[i] = i % 4 == 3 ? std::numeric_limits<double>::infinity()
                             : 30 * key.child(count).uniform(static_cast<std::uint32_t>(i));
      values[i] = 0.5 + static_cast<double>(i);
      expected[i] = values[i] * transmittance(depths[i]);
    }
    absorb_lanes(depths.data(), count, values.data());
    EXPECT_EQ(values, expected);
  }
}

} // namespace
} // namespace abbe::render
