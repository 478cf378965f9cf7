// SPDX-License-Identifier: MIT
#include "image/srgb8.hpp"

#include "image/colour.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace abbe::image {
namespace {

std::uint8_t exact(float light) {
  return static_cast<std::uint8_t>(std::floor(255 * srgb_encode(light) + 0.5));
}

TEST(Srgb8, CodesAreThoseOfTheTransferFunction) {
  // Every 1009th float from 0 to 1: a million of them, in every step of the code.
  auto const one = std::bit_cast<std::uint32_t>(1.0F);
  for (std::uint32_t bits = 0; bits <= one; bits += 1009) {
    auto const light = std::bit_cast<float>(bits);
    ASSERT_EQ(Srgb8::instance().code(light), exact(light)) << light;
  }
}

TEST(Srgb8, StepsAreAtTheRightFloat) {
  for (int code = 1; code < 256; ++code) {
    auto light = static_cast<float>(srgb_decode((code - 0.5) / 255));
    for (int i = 0; i < 8; ++i) light = std::nextafter(light, 0.0F);
    for (int i = 0; i < 16; ++i, light = std::nextafter(light, 1.0F))
      ASSERT_EQ(Srgb8::instance().code(light), exact(light)) << code;
  }
}

TEST(Srgb8, OutsideOfTheRangeEnds) {
  EXPECT_EQ(Srgb8::instance().code(-1), 0);
  EXPECT_EQ(Srgb8::instance().code(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(Srgb8::instance().code(1), 255);
  EXPECT_EQ(Srgb8::instance().code(7), 255);
}

} // namespace
} // namespace abbe::image
