// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "transport/lamps/lamp.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abbe::transport::testing {
namespace {

constexpr double tolerance = 1e-14;

/// Points about the origin, and unit normals there.
struct Places {
  explicit Places(std::size_t many) : count(many) {
    for (std::size_t k = 0; k < chunk_width; ++k) { // kernels compute whole lanes
      auto const number = [&](std::uint64_t dimension) {
        return 4 * RandomKey(k).uniform(dimension) - 2;
      };
      points.set(k, {number(0), number(1), number(2)});
      normals.set(k, glm::normalize(Vec3(number(3), number(4), number(5))));
    }
  }
  std::size_t count;
  Vectors points, normals;
};

std::unique_ptr<Lamp const> lamp_of(scene::Light const& light, double fade_distance = 0,
                                    double fade_power = 0) {
  Lamp::Common common;
  common.value = {1, 1, 1};
  common.fade_distance = fade_distance;
  common.fade_power = fade_power;
  return make_lamp(light, light.position, std::move(common));
}

scene::Light light_at(scene::Light::Kind kind, Vec3 const& position, Vec3 const& point_at) {
  scene::Light light;
  light.kind = kind;
  light.position = position;
  light.point_at = point_at;
  return light;
}
using Kind = scene::Light::Kind;

void expect_near(Vec3 const& a, Vec3 const& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(Lamps, OfAPointAreAimedAtStraight) {
  Vec3 const position(1, 5, -3);
  for (Kind const kind : {Kind::Point, Kind::Spot})
    for (std::size_t const count : {1, 5, 64}) {
      Places const places(count);
      Aim aim;
      lamp_of(light_at(kind, position, Vec3(0)))->aim(places.points, places.normals, count, aim);
      EXPECT_EQ(aim.comes, first_rays(count));
      for (std::size_t k = 0; k < count; ++k) {
        Vec3 const way = position - places.points.get(k);
        EXPECT_NEAR(aim.distance[k], glm::length(way), tolerance * 10);
        expect_near(aim.direction.get(k), way / glm::length(way));
        EXPECT_NEAR(aim.cosine[k], glm::dot(places.normals.get(k), way / glm::length(way)),
                    tolerance);
      }
    }
}

TEST(Lamps, OfAPointSendNoLightToWhereTheyStand) {
  Places places(5);
  places.points.set(3, {1, 5, -3});
  Aim aim;
  lamp_of(light_at(Kind::Point, {1, 5, -3}, Vec3(0)))->aim(places.points, places.normals, 5, aim);
  EXPECT_EQ(aim.comes, RaySet{0b10111});
}

TEST(Lamps, OfParallelLightHaveOneDirectionAndDistancesFromTheirPlane) {
  Vec3 const position(1, 5, -3), direction = glm::normalize(Vec3(2, -1, 0) - position);
  for (std::size_t const count : {1, 5, 64}) {
    Places places(count);
    places.points.set(0, position); // in the plane
    Aim aim;
    lamp_of(light_at(Kind::Parallel, position, {2, -1, 0}))
        ->aim(places.points, places.normals, count, aim);
    EXPECT_EQ(aim.comes, first_rays(count));
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(aim.distance[k], glm::dot(places.points.get(k) - position, direction),
                  tolerance * 10);
      expect_near(aim.direction.get(k), -direction);
      EXPECT_NEAR(aim.cosine[k], -glm::dot(places.normals.get(k), direction), tolerance);
    }
  }
}

TEST(Lamps, ThatPointAtThemselvesPointForward) {
  Places const places(1);
  Aim aim;
  lamp_of(light_at(Kind::Parallel, {1, 2, 3}, {1, 2, 3}))
      ->aim(places.points, places.normals, 1, aim);
  EXPECT_EQ(aim.direction.get(0), Vec3(0, 0, -1));
}

/// What comes of a lamp's light at the first place, 1 where strengths() leaves it alone.
double strength(Lamp const& lamp, Vec3 const& point) {
  Places places(1);
  places.points.set(0, point);
  Aim aim;
  lamp.aim(places.points, places.normals, 1, aim);
  double out[chunk_width] = {};
  return lamp.strengths(aim, 1, 8, out) ? out[0] : 1;
}

TEST(Lamps, FadeByTheirDistanceAndPower) {
  auto const light = light_at(Kind::Point, Vec3(0), {0, 0, 1});
  for (double const power : {1.0, 2.0, 2.5})
    for (double const distance : {0.25, 2.0, 7.0})
      EXPECT_NEAR(strength(*lamp_of(light, 2, power), {0, 0, distance}),
                  2 / (1 + std::pow(distance / 2, power)), tolerance);
  EXPECT_EQ(lamp_of(light, 2, 2)->brightest_fade(), 2);
  // Without both numbers there is no fading.
  for (auto const& even : {lamp_of(light), lamp_of(light, 2, 0), lamp_of(light, 0, 2)}) {
    EXPECT_EQ(even->brightest_fade(), 1);
    EXPECT_EQ(strength(*even, {0, 0, 9}), 1);
  }
}

TEST(Lamps, BehindParallelLightBrokenPowersOfDistancesAreNoLight) {
  auto const light = light_at(Kind::Parallel, Vec3(0), {0, 0, 1});
  EXPECT_NEAR(strength(*lamp_of(light, 2, 2), {0, 0, -4}), 2 / (1 + 4.0), tolerance);
  EXPECT_EQ(strength(*lamp_of(light, 2, 2.5), {0, 0, -4}), 0);
  EXPECT_EQ(strength(*lamp_of(light), {0, 0, -4}), 1);
}

TEST(Lamps, StrengthsOfRaysTogetherAreThoseOfEachAlone) {
  Places const places(8);
  auto const lamp = lamp_of(light_at(Kind::Point, Vec3(0, 9, 0), Vec3(0)), 2, 2);
  Aim aim;
  lamp->aim(places.points, places.normals, 8, aim);
  double out[chunk_width] = {};
  ASSERT_TRUE(lamp->strengths(aim, 0b10010, 8, out));
  for (std::size_t const k : {1, 4}) EXPECT_EQ(out[k], strength(*lamp, places.points.get(k))) << k;
}

double spot(double radius_deg, double falloff_deg, double tightness, double angle_deg) {
  auto light = light_at(Kind::Spot, Vec3(0), {0, 0, 1});
  light.radius_deg = radius_deg;
  light.falloff_deg = falloff_deg;
  light.tightness = tightness;
  double const angle = angle_deg * std::numbers::pi / 180;
  return strength(*lamp_of(light), {3 * std::sin(angle), 0, 3 * std::cos(angle)});
}

TEST(Lamps, SpotsAreWholeWithinTheirRadiusAndNothingBeyondTheirFalloff) {
  auto const cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  for (double const tightness : {0.0, 1.0, 10.0}) {
    for (double const angle : {0.0, 10.0, 29.9})
      EXPECT_NEAR(spot(30, 45, tightness, angle), std::pow(cosine(angle), tightness), 1e-13);
    for (double const angle : {31.0, 38.0, 44.9}) {
      double const x = (cosine(angle) - cosine(45)) / (cosine(30) - cosine(45));
      EXPECT_NEAR(spot(30, 45, tightness, angle),
                  std::pow(cosine(angle), tightness) * x * x * (3 - 2 * x), 1e-13);
    }
    for (double const angle : {45.1, 90.0, 135.0, 180.0})
      EXPECT_EQ(spot(30, 45, tightness, angle), 0);
  }
  // Nothing behind them, however wide they are.
  EXPECT_EQ(spot(170, 175, 0, 100), 0);
  // A falloff within the radius: a hard edge at the radius.
  EXPECT_EQ(spot(30, 10, 0, 29.9), 1);
  EXPECT_EQ(spot(30, 10, 0, 30.1), 0);
}

} // namespace
} // namespace abbe::transport::testing
