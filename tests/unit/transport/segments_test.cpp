// SPDX-License-Identifier: MIT
#include "transport/segments/absorption.hpp"
#include "transport/segments/fade.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::transport::testing {
namespace {

/// Rays of some lanes each, of channels and distances that are theirs.
struct Lanes {
  Lanes(std::size_t rays_, std::size_t each_, std::size_t channels) : rays(rays_), each(each_) {
    for (std::size_t k = 0; k < rays * each; ++k) {
      channel.push_back(static_cast<std::uint16_t>(k * 7 % channels));
      light.push_back(0.5 + 0.25 * static_cast<double>(k % 5));
    }
    for (std::size_t r = 0; r < rays; ++r) distance.push_back(0.3 * static_cast<double>(r % 9));
    before = light;
  }
  Passage passage(bool to_lamp = false) {
    return {rays, each, channel.data(), distance.data(), light.data(), to_lamp};
  }
  /// share(channel, distance) of each lane's light must be left.
  template <class Share>
  void expect_left(Share&& share) const {
    for (std::size_t k = 0; k < rays * each; ++k) {
      double const left = before[k] * share(channel[k], distance[k / each]);
      ASSERT_NEAR(light[k], left, 1e-15) << k;
    }
  }
  std::size_t rays, each;
  std::vector<std::uint16_t> channel;
  std::vector<double> distance, light, before;
};

TEST(Absorption, IsExponentialInEachChannel) {
  std::vector<double> const alpha{0, 0.5, 3, 1e-6};
  Absorption const absorption(alpha);
  // From one lane to more than are worked on at a time.
  for (std::size_t const rays : {1, 3, 64, 700})
    for (std::size_t const each : {1, 3, 8}) {
      Lanes lanes(rays, each, alpha.size());
      absorption.along(lanes.passage());
      lanes.expect_left(
          [&](std::uint16_t c, double distance) { return std::exp(-alpha[c] * distance); });
      // At its end nothing more is taken.
      auto const along = lanes.light;
      absorption.leave(lanes.passage());
      EXPECT_EQ(lanes.light, along);
    }
  EXPECT_FALSE(absorption.acts_where_left());
}

TEST(Absorption, InPartsIsThatOfTheWhole) {
  Absorption const absorption({0.7});
  Lanes whole(1, 1, 1), parts(1, 1, 1);
  whole.distance = {3};
  absorption.along(whole.passage());
  for (double const part : {0.5, 2.25, 0.25}) {
    parts.distance = {part};
    absorption.along(parts.passage());
  }
  EXPECT_NEAR(parts.light[0], whole.light[0], 1e-15);
}

TEST(Fade, IsByThePowerOfTheDistanceAndLeavesItsColour) {
  std::vector<double> const colour{0, 0.25, 1};
  for (double const power : {0.0, 1.0, 2.0, 2.5}) {
    Fade const fade(2, power, colour);
    EXPECT_TRUE(fade.acts_where_left());
    Lanes lanes(20, 3, 3);
    fade.along(lanes.passage()); // only where the medium is left
    EXPECT_EQ(lanes.light, lanes.before);
    fade.leave(lanes.passage());
    lanes.expect_left([&](std::uint16_t c, double distance) {
      return colour[c] + (1 - colour[c]) / (1 + std::pow(distance / 2, power));
    });
  }
}

TEST(Fade, OfPowersFromAThousandOnIsExponential) {
  std::vector<double> const colour{0, 0.25, 1};
  Fade const fade(2, 1000, colour);
  Lanes lanes(20, 3, 3);
  fade.leave(lanes.passage());
  lanes.expect_left(
      [&](std::uint16_t c, double distance) { return std::exp(-(1 - colour[c]) * distance / 2); });
}

TEST(Fade, WithoutAColourIsBlack) {
  Fade const fade(2, 2, {});
  Lanes lanes(20, 3, 3);
  fade.leave(lanes.passage());
  lanes.expect_left(
      [&](std::uint16_t, double distance) { return 1 / (1 + distance * distance / 4); });
}

TEST(Fade, OnTheWayToALampNeedsAPower) {
  for (double const power : {0.0, -1.0, 2.0}) {
    Fade const fade(2, power, {});
    Lanes lanes(5, 1, 1);
    fade.leave(lanes.passage(true));
    EXPECT_EQ(lanes.light == lanes.before, power <= 0) << power;
  }
}

TEST(Segments, AreThoseThatAnInteriorAsksFor) {
  scene::Interior interior;
  EXPECT_TRUE(make_segments(interior, {}, {}, true).empty());
  EXPECT_EQ(make_segments(interior, {0.5}, {}, true).size(), 1);
  interior.fade_distance = 2;
  interior.fade_power = 1;
  EXPECT_EQ(make_segments(interior, {}, {}, true).size(), 1);
  EXPECT_TRUE(make_segments(interior, {}, {}, false).empty()); // the effect is off
  // Both: what is left is the product.
  auto const both = make_segments(interior, {0.5}, {0.25}, true);
  ASSERT_EQ(both.size(), 2);
  Lanes lanes(20, 1, 1);
  for (auto const& segment : both) segment->along(lanes.passage());
  for (auto const& segment : both) segment->leave(lanes.passage());
  lanes.expect_left([](std::uint16_t, double distance) {
    return std::exp(-distance / 2) * (0.25 + 0.75 / (1 + distance / 2));
  });
}

} // namespace
} // namespace abbe::transport::testing
