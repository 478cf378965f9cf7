// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <algorithm>

/// What of a lamp's light arrives at a surface that it lights.
namespace abbe::physics {
namespace {

constexpr double diffuse = 0.5;

/// The origin of the white plane, lit by lamps.
std::string lit(std::string const& lamps, std::string const& objects = "") {
  return look(place(10, 45))
         + plane(fmt::format("pigment {{ rgb 1 }} finish {{ ambient 0 diffuse {} }}", diffuse))
         + objects + lamps;
}
void expect_lit(std::string const& body, Vec3 const& expected) {
  expect_light(body, diffuse * expected);
}

/// A spot straight before the plane whose axis passes the origin at an angle.
std::string spot(double off_axis_deg, std::string const& items) {
  double const distance = 4;
  return lamp({0, 0, -distance}, Vec3(1),
              fmt::format("spotlight point_at <{:.17g}, 0, 0> {}",
                          distance * std::tan(radians(off_axis_deg)), items));
}

TEST(Spot, FallsSmoothlyBetweenItsAngles) {
  auto const cosine = [](double degrees) { return std::cos(radians(degrees)); };
  for (auto const& [radius, falloff] : {std::pair(10.0, 30.0), {0.0, 45.0}, {25.0, 26.0}})
    for (double const off : {0.0, 5.0, 9.9, 12.0, 20.0, 25.4, 29.9, 31.0, 44.0, 60.0}) {
      double const x = std::clamp(
          (cosine(off) - cosine(falloff)) / (cosine(radius) - cosine(falloff)), 0.0, 1.0);
      expect_lit(lit(spot(off, fmt::format("radius {} falloff {}", radius, falloff))),
                 Vec3(x * x * (3 - 2 * x)));
    }
}

TEST(Spot, HasAngles30And45) {
  for (double const off : {29.0, 35.0, 46.0}) {
    double const outer = std::cos(radians(45)), inner = std::cos(radians(30));
    double const x = std::clamp((std::cos(radians(off)) - outer) / (inner - outer), 0.0, 1.0);
    expect_lit(lit(spot(off, "")), Vec3(x * x * (3 - 2 * x)));
  }
}

TEST(Spot, IsTightenedByAPowerOfTheCosine) {
  for (double const tightness : {1.0, 7.5, 100.0})
    for (double const off : {0.0, 5.0, 20.0, 29.0}) {
      double const cosine = std::cos(radians(off));
      double const x = std::clamp((cosine - std::cos(radians(30)))
                                      / (std::cos(radians(10)) - std::cos(radians(30))),
                                  0.0, 1.0);
      expect_lit(lit(spot(off, fmt::format("radius 10 falloff 30 tightness {}", tightness))),
                 Vec3(std::pow(cosine, tightness) * x * x * (3 - 2 * x)));
    }
}

TEST(Spot, HasAHardEdgeWhereNothingIsBetweenItsAngles) {
  for (double const off : {0.0, 19.9, 20.1, 40.0})
    expect_lit(lit(spot(off, "radius 20 falloff 20")), Vec3(off < 20 ? 1 : 0));
}

TEST(Spot, ShinesForwardsOnly) {
  for (double const off : {91.0, 135.0, 180.0}) {
    double const a = radians(off);
    Vec3 const forwards(std::sin(a), 0, std::cos(a)); // to the plane: z
    expect_lit(lit(lamp({0, 0, -4}, Vec3(1),
                        fmt::format("spotlight point_at {} radius 170 falloff 175",
                                    text(Vec3(0, 0, -4) + forwards)))),
               Vec3(0));
  }
}

TEST(Parallel, ComesFromOneDirection) {
  for (double const angle : {0.0, 40.0, 80.0}) {
    Vec3 const from = place(angle, 30, 1);
    // Wherever the lamp is beside its direction.
    for (Vec3 const& off : {Vec3(0), Vec3(3, -2, 0), Vec3(0, 50, 0)})
      expect_lit(lit(lamp(10.0 * from + off, Vec3(1), "parallel point_at " + text(off))),
                 Vec3(std::cos(radians(angle))));
  }
}

TEST(Parallel, IsShadowedBetweenItsPlaneAndTheSurface) {
  auto const ball = [](double z) { return fmt::format("sphere {{ {}*z, 0.5 }}\n", z); };
  std::string const sun = lamp({3, 2, -5}, Vec3(1), "parallel point_at <3, 2, 0>");
  expect_lit(lit(sun, ball(-3)), Vec3(0));
  expect_lit(lit(sun, ball(-8)), Vec3(1)); // the plane of the lamp is at z = -5
}

TEST(Fade, IsOneAtItsDistance) {
  for (double const power : {1.0, 2.0, 3.5})
    for (double const distance : {0.5, 2.0, 5.0, 20.0})
      expect_lit(lit(lamp(place(35, 80, distance), Vec3(0.2, 1, 3),
                          fmt::format("fade_distance 2 fade_power {}", power))),
                 Vec3(0.2, 1, 3) * std::cos(radians(35)) * 2.0
                     / (1 + std::pow(distance / 2, power)));
}

TEST(Fade, NeedsBothItsNumbers) {
  for (char const* items : {"fade_distance 2", "fade_power 2"})
    expect_lit(lit(lamp(place(0), Vec3(1), items)), Vec3(1));
}

TEST(Fade, OfParallelLightIsMeasuredFromThePlaneOfTheLamp) {
  // Along the direction from the origin: of the 10 of z the share that goes this way.
  Vec3 const at(6, 0, -8); // 10 away, and its light comes straight
  expect_lit(lit(lamp(at, Vec3(1), "parallel point_at <6, 0, 0> fade_distance 4 fade_power 2")),
             Vec3(2.0 / (1 + 4.0)));
}

TEST(Fade, OfASpotGoesWithItsAngle) {
  double const cosine = std::cos(radians(8));
  expect_lit(lit(spot(8, "radius 10 falloff 20 tightness 4 fade_distance 1 fade_power 2")),
             Vec3(std::pow(cosine, 4) * 2 / (1 + 16.0)));
}

TEST(Shadows, AreCastByWhatIsOpaque) {
  std::string const pane = "box { <-9, -9, -2.1>, <9, 9, -2> pigment { rgb 1 } }\n";
  std::string const eye = look({0, 0, -1}); // below the pane
  auto const under = [&](std::string const& lamps, std::string const& what) {
    return eye + plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 }") + what + lamps;
  };
  Vec3 const at = place(20);
  double const cosine = std::cos(radians(20));
  expect_lit(under(lamp(at), pane), Vec3(0));
  expect_lit(under(lamp(at, Vec3(1), "shadowless"), pane), Vec3(cosine));
  expect_lit(under(lamp(at), "box { <-9, -9, -2.1>, <9, 9, -2> no_shadow }\n"), Vec3(cosine));
  expect_lit(under(lamp(at), "box { <-9, -9, -9>, <9, 9, -8> }\n"), Vec3(cosine)); // behind it
  expect_lit(under(lamp(at) + lamp(-1.0 * at, Vec3(1)), ""), Vec3(cosine));
}

TEST(Shadows, AreFilteredOnceASurface) {
  Vec3 const paint(0.9, 0.5, 0.25);
  auto const pane = [&](double filter, double transmit) {
    return fmt::format(
        "box {{ <-9, -9, -2.1>, <9, 9, -2> pigment {{ rgbft <0.9, 0.5, 0.25, {}, {}> "
        "}} }}\n",
        filter, transmit);
  };
  auto const under = [&](std::string const& what) {
    return look({0, 0, -1}) + plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 }") + what
           + lamp(place(50, 20), {1, 2, 4});
  };
  auto const passed = [&](double filter, double transmit) {
    Vec3 const once = filter * paint + transmit;
    return once * once * Vec3(1, 2, 4) * std::cos(radians(50));
  };
  expect_lit(under(pane(0.7, 0)), passed(0.7, 0));
  expect_lit(under(pane(0, 0.4)), passed(0, 0.4));
  expect_lit(under(pane(0.5, 0.3)), passed(0.5, 0.3));
}

} // namespace
} // namespace abbe::physics
