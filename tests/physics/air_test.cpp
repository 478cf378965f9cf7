// SPDX-License-Identifier: MIT
#include "pixel.hpp"

/// Fog and rainbows against closed formulas.
namespace abbe::physics {
namespace {

constexpr double glow = 0.8; ///< of the plane

/// The glowing plane through the origin, seen from `eye`, with something in the air.
std::string seen(Vec3 const& eye, std::string const& air, std::string const& objects = "") {
  return look(eye)
         + plane(fmt::format("pigment {{ rgb 1 }} finish {{ ambient {} diffuse 0 }}", glow))
         + objects + air;
}
/// What fog of a colour leaves and adds.
Vec3 through(double share, Vec3 const& fog) {
  return share * Vec3(glow) + (1 - share) * fog;
}

TEST(Fog, KeepsTheExponentialOfTheWay) {
  for (double const way : {0.5, 4.0, 20.0})
    for (double const distance : {1.0, 7.0, 1000.0})
      expect_light(
          seen(place(30, 20, way), fmt::format("fog {{ distance {} rgb <1, 0.5, 0> }}", distance)),
          through(std::exp(-way / distance), {1, 0.5, 0}));
}

TEST(Fog, FiltersAndLetsALeastSharePass) {
  Vec3 const colour(0.9, 0.5, 0.1);
  double const share = std::exp(-5 / 3.0);
  expect_light(seen(place(0), "fog { distance 3 rgbf <0.9, 0.5, 0.1, 0.4> }"),
               share * glow * (0.6 + 0.4 * colour) + (1 - share) * colour);
  expect_light(seen(place(0), "fog { distance 3 rgbt <0.9, 0.5, 0.1, 0.7> }"),
               through(0.7, colour));
}

TEST(Fog, OfSeveralKindsMultipliesAndAdds) {
  double const a = std::exp(-5 / 3.0), b = std::exp(-5 / 8.0);
  expect_light(seen(place(0), "fog { distance 3 rgb x } fog { distance 8 rgb y }"),
               Vec3(a * b * glow) + (1 - a) * Vec3(1, 0, 0) + (1 - b) * Vec3(0, 1, 0));
}

/// The mean of ground fog's density along a way, by Simpson's rule.
double mean_density(double from, double to, double offset, double alt) {
  auto const at = [&](double t) {
    double const x = (from + t * (to - from) - offset) / alt;
    return x <= 0 ? 1 : 1 / (1 + x * x);
  };
  constexpr int steps = 20000;
  double sum = at(0) + at(1);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * at(static_cast<double>(i) / steps);
  return sum / (3 * steps);
}

TEST(GroundFog, HasTheMeanOfItsDensity) {
  // Heights of the eye; the plane's point is at 0.
  for (double const height : {-4.0, -0.5, 1e-9, 2.0, 3.0})
    for (double const offset : {-2.0, 0.0, 1.5, 9.0})
      for (double const alt : {0.2, 3.0}) {
        Vec3 const eye(1, height, -4);
        double const depth = glm::length(eye) * mean_density(height, 0, offset, alt);
        auto const image = picture(
            seen(eye, fmt::format("fog {{ fog_type 2 distance 5 fog_offset {} fog_alt {} rgb z }}",
                                  offset, alt)));
        Vec3 const expected = through(std::exp(-depth / 5), {0, 0, 1});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(image, 0, 0)[c], expected[c], 1e-6);
      }
}

TEST(GroundFog, EndsAboveAWayWithoutEnd) {
  // From a height of 2 upwards at 45 degrees: the arc from there on.
  double const depth = std::sqrt(2.0) * (std::numbers::pi / 2 - std::atan(2.0));
  expect_light("camera { location 2*y direction <0, 1, 1> right 1e-9*x up 1e-9*y }\n"
               "background { rgb 0.5 } sphere { -9*z, 1 }\n"
               "fog { fog_type 2 distance 3 fog_alt 1 rgb 0 }",
               Vec3(0.5 * std::exp(-depth / 3)));
}

TEST(Fog, IsOutsideOfWhatIsNotHollow) {
  // Of a way of 5 along z, 2 are in the box.
  auto const box = [](char const* more) {
    return fmt::format("box {{ <-9, -9, -3>, <9, 9, -1> pigment {{ rgbt 1 }} finish {{ ambient 0 "
                       "diffuse 0 }} {} }}\n",
                       more);
  };
  std::string const fog = "fog { distance 2 rgb 0 }";
  expect_light(seen(place(0), fog, box("")), Vec3(glow * std::exp(-1.5)));
  expect_light(seen(place(0), fog, box("hollow")), Vec3(glow * std::exp(-2.5)));
  expect_light(seen(place(0), fog, box("interior { ior 1 }")), Vec3(glow * std::exp(-1.5)));
  // Where the camera stands in it.
  expect_light(seen(place(0, 0, 2), fog, box("")), Vec3(glow * std::exp(-0.5)));
}

TEST(Fog, WeakensLampsThatSaySo) {
  auto const lit = [](std::string const& items) {
    return look(place(0)) + plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 }")
           + lamp(place(60, 0, 4), Vec3(1), items) + "fog { distance 8 rgb 0 }";
  };
  double const arriving = 0.5 * 0.5 * std::exp(-5 / 8.0);
  expect_light(lit(""), Vec3(arriving));
  expect_light(lit("media_attenuation on"), Vec3(arriving * std::exp(-4 / 8.0)));
  expect_light(lit("media_attenuation on media_interaction off"), Vec3(arriving));
  // Through what filters light too, and not within it.
  std::string const pane = "box { <-9, -9, -1.5>, <9, 9, -1> pigment { rgbt 1 } no_image }\n";
  expect_light(pane + lit("media_attenuation on"), Vec3(arriving * std::exp(-3 / 8.0)));
}

TEST(Fog, ActsOnMirroredLight) {
  // The plane mirrors a sky at 7 along the way back.
  expect_light(look(place(0))
                   + plane("pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.5 }")
                   + "plane { z, -7 pigment { rgb 1 } finish { ambient 1 diffuse 0 } no_image }\n"
                     "fog { distance 4 rgb y }",
               0.5 * std::exp(-5 / 4.0)
                       * (std::exp(-7 / 4.0) * Vec3(1) + (1 - std::exp(-7 / 4.0)) * Vec3(0, 1, 0))
                   + (1 - std::exp(-5 / 4.0)) * Vec3(0, 1, 0));
}

/// A rainbow about the way to the origin turned by an angle, in red.
std::string bow(double off_deg, std::string const& items) {
  double const a = radians(off_deg);
  return fmt::format("rainbow {{ direction {} angle 10 width 4 distance 6 {} }}\n",
                     text({std::sin(a), 0, std::cos(a)}), items);
}
std::string const red = "color_map { [0 rgb 0] [1 rgb x] }";

TEST(Rainbow, IsARingOfItsColours) {
  double const share = std::exp(-5 / 6.0);
  for (double const off : {7.9, 8.5, 10.0, 11.9, 12.1}) {
    bool const within = off > 8 && off < 12;
    double const at = (off - 8) / 4;
    auto const image = picture(seen(place(0), bow(off, red)));
    Vec3 const expected = within ? through(share, {at, 0, 0}) : Vec3(glow);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(image, 0, 0)[c], expected[c], 1e-6) << off;
  }
}

TEST(Rainbow, FadesTowardsTheEndsOfItsArc) {
  // The direction is beside the way, so the way is beside it by 90 degrees of the arc.
  auto const at = [&](std::string const& items) {
    auto const image = picture(
        seen(place(0), bow(10, "distance 1e-3 color_map { [0 rgb x] [1 rgb x] } " + items)));
    return 1 - pixel(image, 0, 0).y / glow;
  };
  EXPECT_NEAR(at(""), 1, 1e-6);
  EXPECT_NEAR(at("arc_angle 170"), 0, 1e-6);
  EXPECT_NEAR(at("arc_angle 190"), 1, 1e-6);
  double const x = (100 - 90) / (100.0 - 60);
  EXPECT_NEAR(at("arc_angle 200 falloff_angle 120"), x * x * (3 - 2 * x), 1e-6);
}

TEST(Rainbow, IsTheMeanOfThoseThatAreMet) {
  double const a = std::exp(-5 / 6.0), b = std::exp(-5 / 2.0);
  std::string const two = bow(10, "color_map { [0 rgb x] [1 rgb x] }")
                          + bow(10, "distance 2 color_map { [0 rgb y] [1 rgb y] }") + bow(40, red);
  expect_light(seen(place(0), two), 0.5 * (through(a, {1, 0, 0}) + through(b, {0, 1, 0})));
}

} // namespace
} // namespace abbe::physics
