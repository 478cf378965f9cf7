// SPDX-License-Identifier: MIT
#include "render/marks.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <span>
#include <vector>

/// Which pixels anti-aliasing of method 1 makes again.
namespace abbe::render {
namespace {

using ::testing::ElementsAre;
using Row = std::vector<float>;

/// Grey pixels.
Row grey(std::vector<float> const& values) {
  Row out;
  for (float const value : values) out.insert(out.end(), 3, value);
  return out;
}

TEST(AsSeen, IsLightToTheGamma2Point5OfWhatADisplayShows) {
  for (double const light : {0.0, 0.01, 0.2, 0.5, 1.0})
    EXPECT_NEAR(as_seen(light), std::pow(light, 0.4), 1e-15);
  EXPECT_EQ(as_seen(-0.5), 0);
  EXPECT_EQ(as_seen(7), 1);
}

TEST(Marks, AreOfBothPixelsThatDiffer) {
  EXPECT_THAT(mark_differences(grey({0, 0, 1, 1, 1}), 5, {}, {}, 0.3), ElementsAre(0, 1, 1, 0, 0));
  EXPECT_THAT(mark_differences(grey({0, 0, //
                                     0, 0, //
                                     0, 1}),
                               2, {}, {}, 0.3),
              ElementsAre(0, 0, 0, 1, 1, 1));
}

TEST(Marks, AreOfNeighboursBesideAndAboveOnly) {
  EXPECT_THAT(mark_differences(grey({0, 0, 0, //
                                     0, 1, 0, //
                                     0, 0, 0}),
                               3, {}, {}, 0.3),
              ElementsAre(0, 1, 0, 1, 1, 1, 0, 1, 0));
  // The end of a row and the beginning of the next are no neighbours.
  EXPECT_THAT(mark_differences(grey({0, 0.5, 1, 0, 0.5, 1}), 3, {}, {}, 1.3),
              ElementsAre(1, 1, 0, 1, 1, 0));
}

TEST(Marks, CompareAllComponentsTogether) {
  Row const pixels{0, 0, 0, 0.1f, 0.2f, 0.3f};
  double const difference =
      std::pow(double(0.1f), 0.4) + std::pow(double(0.2f), 0.4) + std::pow(double(0.3f), 0.4);
  EXPECT_THAT(mark_differences(pixels, 2, {}, {}, difference - 1e-9), ElementsAre(1, 1));
  EXPECT_THAT(mark_differences(pixels, 2, {}, {}, difference + 1e-9), ElementsAre(0, 0));
  // Components that change in opposite directions do not cancel.
  EXPECT_THAT(mark_differences(Row{1, 0, 0, 0, 1, 0}, 2, {}, {}, 2), ElementsAre(1, 1));
}

TEST(Marks, TakeAThresholdThatIsMetAsDifferent) {
  EXPECT_THAT(mark_differences(grey({0, 1}), 2, {}, {}, 3), ElementsAre(1, 1));
  EXPECT_THAT(mark_differences(grey({0.5, 0.5}), 2, {}, {}, 0), ElementsAre(1, 1));
}

TEST(Marks, SeeNoDifferenceBetweenWhatADisplayShowsAlike) {
  EXPECT_THAT(mark_differences(grey({1, 100, -1, 0}), 4, {}, {}, 0.01), ElementsAre(0, 1, 1, 0));
}

TEST(Marks, ReachAcrossTheRowsAboveAndBelow) {
  Row const row = grey({0, 0, 0}), above = grey({1, 0, 0}), below = grey({0, 0, 1});
  EXPECT_THAT(mark_differences(row, 3, above, {}, 0.3), ElementsAre(1, 0, 0));
  EXPECT_THAT(mark_differences(row, 3, {}, below, 0.3), ElementsAre(0, 0, 1));
  EXPECT_THAT(mark_differences(row, 3, above, below, 0.3), ElementsAre(1, 0, 1));
}

/// Whole or in strips of some rows with their neighbours: the same marks.
TEST(Marks, OfStripsAreThoseOfThePicture) {
  constexpr std::size_t width = 7, height = 9;
  Row picture;
  for (std::size_t i = 0; i < 3 * width * height; ++i)
    picture.push_back(static_cast<float>(i * i % 97) / 97);
  std::span<float const> const all(picture);
  auto const whole = mark_differences(all, width, {}, {}, 0.9);
  EXPECT_THAT(whole, ::testing::Contains(0));
  EXPECT_THAT(whole, ::testing::Contains(1));
  auto const rows = [&](std::size_t first, std::size_t count) {
    return all.subspan(3 * width * first, 3 * width * count);
  };
  for (std::size_t const each : {1, 2, 4}) {
    std::vector<std::uint8_t> marks;
    for (std::size_t y = 0; y < height; y += each) {
      std::size_t const count = std::min(each, height - y);
      auto const some = mark_differences(
          rows(y, count), width, rows(y > 0 ? y - 1 : 0, y > 0 ? 1 : 0),
          rows(y + count < height ? y + count : 0, y + count < height ? 1 : 0), 0.9);
      marks.insert(marks.end(), some.begin(), some.end());
    }
    EXPECT_EQ(marks, whole) << each;
  }
}

} // namespace
} // namespace abbe::render
