// SPDX-License-Identifier: MIT
#include "stages.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::transport::testing {
namespace {

TEST(SampleKey, NumbersOfAPixelsSamplesStepByIrrationals) {
  auto const keys = sample_keys(100);
  for (auto const& key : keys)
    for (std::uint64_t const dimension : {0, 1, 2, 3}) {
      double const value = key.uniform(dimension);
      EXPECT_GE(value, 0);
      EXPECT_LT(value, 1);
      double const step[] = {0.6180339887498949, 0.7548776662466927, 0.5698402909980532};
      double const steps = value - keys[0].uniform(dimension)
                           - static_cast<double>(key.number) * step[dimension % 3];
      EXPECT_NEAR(steps, std::round(steps), 1e-9);
    }
  // Numbers of a sample alone have no such order, and those of neighbouring pixels are others.
  EXPECT_NE(keys[0].independent(0), keys[1].independent(0));
  EXPECT_NE(keys[0].uniform(0), sample_keys(1, 1)[0].uniform(0));
  EXPECT_NE(keys[0].blue(), sample_keys(1, 1)[0].blue());
}

} // namespace
} // namespace abbe::transport::testing
