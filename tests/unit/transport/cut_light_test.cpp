// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "transport/cut_light.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abbe::transport::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most = 0x1p16;

double sum_of(std::vector<double> const& lights) {
  LightSum sum;
  for (double const light : lights) sum.add(light);
  return sum.value();
}

TEST(LightSum, IsTheSameInAnyOrder) {
  // Of all sizes: as sums of doubles, most orders have their own result.
  std::vector<double> lights;
  double in_order = 0;
  for (std::uint64_t k = 0; k < 500; ++k) {
    lights.push_back(std::ldexp(1 + RandomKey(2).uniform(k), static_cast<int>(k % 50) - 45));
    in_order += lights.back();
  }
  double const sum = sum_of(lights);
  std::vector<double> backwards(lights.rbegin(), lights.rend());
  EXPECT_EQ(sum_of(backwards), sum);
  std::sort(lights.begin(), lights.end());
  EXPECT_EQ(sum_of(lights), sum);
  // Rounded up, by a unit each at most.
  EXPECT_GE(sum, in_order * (1 - 1e-12));
  EXPECT_LE(sum, in_order + 500 * 0x1p-44 + 1e-12);
}

TEST(LightSum, IsNeverLessThanWhatWasAdded) {
  for (double const light : {0x1p-44, 0x1.8p-45, 1e-300, 0.1, 1.0, 3.75})
    EXPECT_GE(sum_of({light}), light);
  EXPECT_EQ(sum_of({1e-300}), 0x1p-44);
  EXPECT_EQ(sum_of({0.5, 0.25, 4}), 4.75);
}

TEST(LightSum, WhatIsNotAboveZeroAddsNothing) {
  EXPECT_EQ(sum_of({0, -1, -infinity, std::numeric_limits<double>::quiet_NaN()}), 0);
}

TEST(LightSum, EndsWhereEverythingIsLostAndIsStillTheSameInAnyOrder) {
  EXPECT_EQ(sum_of({infinity}), most);
  EXPECT_EQ(sum_of({1, infinity, 1}), most);
  EXPECT_EQ(sum_of({infinity, infinity, 3}), most);
  EXPECT_EQ(sum_of({3, most}), sum_of({most, 3}));
}

TEST(CutLight, AddsPathsAndUnitsAndKeepsTheWorstSample) {
  CutLight a{3, CutLight::units_of(0.5), 0.5}, b{4, CutLight::units_of(0.25), 0.25};
  CutLight sum = a;
  sum.add(b);
  EXPECT_EQ(sum.paths, 7);
  EXPECT_EQ(static_cast<double>(sum.sum) * CutLight::unit, 0.75);
  EXPECT_EQ(sum.worst_sample, 0.5);
  b.add(a);
  EXPECT_EQ(b.sum, sum.sum);
  EXPECT_EQ(b.worst_sample, 0.5);
}

TEST(CutLight, UnitsAreRoundedUp) {
  EXPECT_EQ(CutLight::units_of(0), 0);
  EXPECT_EQ(CutLight::units_of(1e-300), 1);
  EXPECT_EQ(CutLight::units_of(CutLight::unit), 1);
  EXPECT_EQ(CutLight::units_of(1.5 * CutLight::unit), 2);
  EXPECT_EQ(CutLight::units_of(infinity), CutLight::units_of(most));
}

} // namespace
} // namespace abbe::transport::testing
