// SPDX-License-Identifier: MIT
#include "pixel.hpp"

/// Light that a surface mirrors, of a background of one colour.
namespace abbe::physics {
namespace {

constexpr Vec3 sky(0.6, 0.8, 1.5);
constexpr Vec3 least(0.1, 0.2, 0.05), most(0.7, 0.9, 0.6);
constexpr double angles[] = {0, 30, 60, 85};

/// @param texture of the plane; it glows by 0.1 of its paint
std::string under_sky(double angle_deg, std::string const& texture, std::string const& more = "") {
  return fmt::format("background {{ rgb {} }}\n", text(sky)) + look(place(angle_deg, 20))
         + plane(texture) + more;
}
constexpr Vec3 paint(0.3, 0.5, 0.9);
std::string mirror(std::string const& items, std::string const& more = "") {
  return fmt::format("pigment {{ rgb {} }} finish {{ ambient 0.1 diffuse 0 {} }} {}", text(paint),
                     items, more);
}
constexpr Vec3 glow = 0.1 * paint;

TEST(Reflection, IsConstantAsOneColour) {
  for (double const angle : angles) {
    expect_light(under_sky(angle, mirror("reflection " + text(most))), glow + most * sky);
    expect_light(under_sky(angle, mirror(fmt::format("reflection {{ rgb {} }}", text(most)))),
                 glow + most * sky);
  }
}

TEST(Reflection, GoesFromOneColourToTheOtherByFalloff) {
  for (double const falloff : {1.0, 0.5, 3.0})
    for (double const angle : angles) {
      double const share = std::pow(1 - std::cos(radians(angle)), falloff);
      expect_light(under_sky(angle, mirror(fmt::format("reflection {{ rgb {}, rgb {} falloff {} }}",
                                                       text(least), text(most), falloff))),
                   glow + (least + (most - least) * share) * sky);
    }
}

/// Fresnel's formulas for unpolarised light from air.
double fresnel(double angle_deg, double ior) {
  double const i = radians(angle_deg), cos_i = std::cos(i);
  double const cos_t = std::sqrt(1 - std::pow(std::sin(i) / ior, 2));
  double const s = (cos_i - ior * cos_t) / (cos_i + ior * cos_t);
  double const p = (cos_t - ior * cos_i) / (cos_t + ior * cos_i);
  return (s * s + p * p) / 2;
}

TEST(Reflection, FollowsFresnelByTheIndex) {
  for (double const ior : {1.33, 1.5, 2.4})
    for (double const angle : angles) {
      double const share = fresnel(angle, ior);
      std::string const inside = fmt::format("interior {{ ior {} }}", ior);
      expect_light(under_sky(angle, mirror(fmt::format("reflection {{ rgb {}, rgb {} fresnel }}",
                                                       text(least), text(most)),
                                           inside)),
                   glow + (least + (most - least) * share) * sky);
      expect_light(
          under_sky(angle,
                    mirror(fmt::format("reflection {{ rgb {} fresnel on }}", text(most)), inside)),
          glow + most * share * sky);
    }
}

TEST(Reflection, RaisesWhatIsMirroredToTheInverseOfItsExponent) {
  Vec3 const raised(std::pow(sky.x, 0.4), std::pow(sky.y, 0.4), std::pow(sky.z, 0.4));
  for (double const angle : angles) {
    expect_light(
        under_sky(angle, mirror(fmt::format("reflection {{ rgb {} exponent 2.5 }}", text(most)))),
        glow + most * raised);
    expect_light(under_sky(angle, mirror(fmt::format("reflection rgb {} reflection_exponent 2.5",
                                                     text(most)))),
                 glow + most * raised);
  }
}

TEST(Reflection, OfMetalIsTintedLessAtGrazingAngles) {
  for (double const angle : angles)
    for (double const amount : {1.0, 0.3}) {
      Vec3 const tint = metallic(amount, std::cos(radians(angle)), paint);
      expect_light(under_sky(angle, mirror(fmt::format("reflection {{ rgb {} metallic {} }}",
                                                       text(most), amount))),
                   glow + most * tint * sky);
    }
}

/// A luminous wall behind the plane: what passes the plane is of this colour.
constexpr Vec3 wall(0.9, 0.4, 0.2);
std::string behind() {
  return fmt::format(
      "plane {{ -z, -5 pigment {{ rgb {} }} finish {{ ambient 0 diffuse 0 emission 1 "
      "}} }}\n",
      text(wall));
}

TEST(Reflection, TakesNothingFromWhatPasses) {
  for (double const angle : angles)
    expect_light(under_sky(angle,
                           fmt::format("pigment {{ rgbt {} }} finish {{ ambient 0 diffuse 0 "
                                       "reflection {} }}",
                                       "<0, 0, 0, 0.6>", text(most)),
                           behind()),
                 0.6 * wall + most * sky);
}

TEST(ConserveEnergy, LetsPassWhatIsNotMirrored) {
  for (double const angle : angles) {
    double const share = 1 - std::cos(radians(angle));
    Vec3 const mirrors = least + (most - least) * share;
    expect_light(
        under_sky(angle,
                  fmt::format("pigment {{ rgbft <0.3, 0.5, 0.9, 0.5, 0.25> }} finish {{ ambient 0 "
                              "diffuse 0 reflection {{ rgb {}, rgb {} }} conserve_energy }}",
                              text(least), text(most)),
                  behind()),
        (0.5 * paint + 0.25) * (Vec3(1) - mirrors) * wall + mirrors * sky);
  }
}

TEST(ConserveEnergy, LetsNothingPassWhereMoreIsMirroredThanComes) {
  expect_light(under_sky(30,
                         "pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection <0.5, 1, 1.5> "
                         "conserve_energy }",
                         behind()),
               Vec3(0.5, 1, 1.5) * sky + Vec3(0.5, 0, 0) * wall);
}

TEST(Reflection, OfTwoMirrorsMultiplies) {
  // A ray at 45 degrees meets the plane, then a wall at a right angle, then leaves.
  std::string const second = "plane { x, -3 pigment { rgb 0 } finish { ambient 0 diffuse 0 "
                             "reflection 0.5 } }\n";
  expect_light(under_sky(45, mirror("reflection " + text(most)), ""), glow + most * sky);
  expect_light(fmt::format("background {{ rgb {} }}\n", text(sky)) + look(place(45))
                   + plane(mirror("reflection " + text(most))) + second,
               glow + most * 0.5 * sky);
}

TEST(Mirror, OfMetalShowsNothingWhereReflectionIsOff) {
  expect_light(
      look(place(10))
          + plane("pigment { rgb 1 } finish { ambient 0 diffuse 0.5 reflection { metal \"Au\" } }")
          + lamp({0, 0, -4}) + "effects { reflection off }\n",
      Vec3(0.5));
}

} // namespace
} // namespace abbe::physics
