// SPDX-License-Identifier: MIT
#include "texture/pattern.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace abbe::texture {
namespace {

void expect(MapPosition const& at, int first, int second, double weight) {
  EXPECT_EQ(at.first, first);
  if (weight != 0) {
    EXPECT_EQ(at.second, second);
  }
  EXPECT_NEAR(at.weight, weight, 1e-15);
}

TEST(LookUp, BlendsBetweenNeighbours) {
  std::array const map{0.0, 0.5, 1.0};
  expect(look_up(map, 0.125), 0, 1, 0.25);
  expect(look_up(map, 0.5), 1, 1, 0);
  expect(look_up(map, 0.75), 1, 2, 0.5);
}

TEST(LookUp, HoldsTheEndsBeyondTheMap) {
  std::array const map{0.2, 0.8};
  expect(look_up(map, 0.1), 0, 0, 0);
  expect(look_up(map, 0.2), 0, 0, 0);
  expect(look_up(map, 0.8), 1, 1, 0);
  expect(look_up(map, 5), 1, 1, 0);
}

TEST(LookUp, TakesTheFirstOfEqualsAtAStep) {
  std::array const map{0.0, 0.5, 0.5, 0.5, 1.0};
  expect(look_up(map, 0.5), 1, 1, 0);
  expect(look_up(map, std::nextafter(0.5, 1)), 3, 4, 2 * (std::nextafter(0.5, 1) - 0.5));
  expect(look_up(map, 0.25), 0, 1, 0.5);
}

TEST(LookUp, TakesTheLastAtAStepAtTheEnd) {
  std::array const map{0.0, 0.9, 0.9};
  expect(look_up(map, 0.9), 2, 2, 0);
}

TEST(LookUp, OfOneEntryIsThatEntry) {
  std::array const map{0.4};
  for (double v : {0.0, 0.4, 1.0}) expect(look_up(map, v), 0, 0, 0);
}

TEST(LookUp, OfNanIsInsideTheMap) {
  std::array const map{0.0, 1.0};
  expect(look_up(map, std::nan("")), 0, 0, 0);
}

} // namespace
} // namespace abbe::texture
