// SPDX-License-Identifier: MIT
#include "pixel.hpp"

/// What a surface sends to the eye of its own light and of a lamp's, without highlights.
namespace abbe::physics {
namespace {

constexpr Vec3 paint(0.8, 0.5, 0.3);
constexpr Vec3 white(1);

std::string finish(std::string const& items) {
  return fmt::format("pigment {{ rgb {} }} finish {{ {} }}", text(paint), items);
}

TEST(Glow, IsAmbientTimesAmbientLightAndEmission) {
  Vec3 const ambient(0.2, 0.3, 0.4), emission(0.05, 0.1, 0.2), all_around(0.5, 1, 2);
  std::string const items =
      fmt::format("ambient rgb {} emission rgb {} diffuse 0", text(ambient), text(emission));
  for (double const angle : {0, 50, 85}) {
    expect_light(look(place(angle)) + plane(finish(items)), paint * (ambient + emission));
    expect_light(fmt::format("global_settings {{ ambient_light rgb {} }}\n", text(all_around))
                     + look(place(angle)) + plane(finish(items)),
                 paint * (ambient * all_around + emission));
  }
}

TEST(Glow, OfADefaultFinishIsATenth) {
  expect_light(look(place(10)) + plane("pigment { rgb 0.5 }"), Vec3(0.05));
}

TEST(Opacity, IsWhatIsNeitherFilteredNorTransmitted) {
  auto const body = [](std::string const& version, double filter, double transmit) {
    return version + look(place(20))
           + plane(fmt::format("pigment {{ rgbft <0.8, 0.5, 0.3, {}, {}> }} "
                               "finish {{ ambient 0.25 diffuse 0.75 }}",
                               filter, transmit))
           + lamp(place(60), white);
  };
  double const given = 0.25 + 0.75 * std::cos(radians(60));
  expect_light(body("", 0.3, 0.2), paint * given * 0.5);
  expect_light(body("", 0, 0.7), paint * given * 0.3);
  // Before 3.7 what a filter lets through depends on its colour.
  expect_light(body("#version 3.6;", 0.3, 0.2), paint * given * (1 - (0.3 * 0.8 + 0.2)));
}

TEST(Diffuse, FollowsLambertsCosine) {
  for (double const angle : {0.0, 30.0, 60.0, 80.0, 89.0})
    for (double const eye : {0.0, 45.0, 88.0}) // seen alike from everywhere
      expect_light(look(place(eye, 100)) + plane(finish("ambient 0 diffuse 0.7"))
                       + lamp(place(angle), {1, 0.5, 2}),
                   paint * Vec3(1, 0.5, 2) * 0.7 * std::cos(radians(angle)));
}

TEST(Diffuse, OfASphereFollowsItsNormal) {
  // The ray along z through <x, y> meets the sphere at z = -sqrt(1 - x^2 - y^2).
  Vec3 const at_lamp(3, 4, -5);
  for (Vec3 at : {Vec3(0, 0, 0), Vec3(0.3, -0.4, 0), Vec3(-0.1, 0.6, 0), Vec3(0.7, 0.7, 0)}) {
    std::string const camera = fmt::format("camera {{ orthographic location {} direction z {} }}\n",
                                           text(at - Vec3(0, 0, 9)), narrow);
    at.z = -std::sqrt(1 - at.x * at.x - at.y * at.y);
    double const cosine = glm::dot(at, glm::normalize(at_lamp - at));
    ASSERT_GT(cosine, 0);
    expect_light(camera + "sphere { 0, 1 " + finish("ambient 0 diffuse 1") + "}\n" + lamp(at_lamp),
                 paint * cosine);
  }
}

TEST(Diffuse, RisesToThePowerOfBrilliance) {
  for (double const brilliance : {0.5, 2.0, 5.25})
    for (double const angle : {0.0, 40.0, 85.0}) {
      double const given = 0.4 * std::pow(std::cos(radians(angle)), brilliance);
      std::string const items = fmt::format("0.4 ambient 0 brilliance {}", brilliance);
      expect_light(look(place(10)) + plane(finish("diffuse " + items)) + lamp(place(angle)),
                   paint * given);
      // An albedo is the share of all light that is sent on.
      expect_light(look(place(10)) + plane(finish("diffuse albedo " + items)) + lamp(place(angle)),
                   paint * given * (brilliance + 1) / 2.0);
    }
}

TEST(Diffuse, OfLightFromBehindIsTheSecondNumber) {
  Vec3 const behind = -place(130); // the lamp is at an angle of 50 degrees behind the plane
  double const cosine = std::cos(radians(50));
  auto const seen = [&](std::string const& items, std::string const& flags = "") {
    return look(place(20)) + plane(finish(items + " ambient 0") + flags)
           + lamp({behind.x, behind.y, std::abs(behind.z)});
  };
  expect_light(seen("diffuse 0.6"), Vec3(0));
  expect_light(seen("diffuse 0.6, 0.3"), paint * 0.3 * cosine);
  expect_light(seen("diffuse 0.6, 0.3 brilliance 3"), paint * 0.3 * std::pow(cosine, 3));
  expect_light(seen("diffuse albedo 0.6, 0.3 brilliance 3"),
               paint * 0.3 * 2.0 * std::pow(cosine, 3));
  // A lamp on the eye's side has no use for it.
  expect_light(look(place(20)) + plane(finish("diffuse 0.6, 0.3 ambient 0")) + lamp(place(50)),
               paint * 0.6 * cosine);
}

TEST(Diffuse, DoubleIlluminateTakesLightFromBehindAsFromTheFront) {
  double const cosine = std::cos(radians(50));
  auto const seen = [&](std::string const& items, double z) {
    Vec3 at = place(50);
    at.z *= z;
    return look(place(20)) + plane(finish(items + " ambient 0") + " double_illuminate") + lamp(at);
  };
  for (double const side : {1.0, -1.0}) {
    expect_light(seen("diffuse 0.6", side), paint * 0.6 * cosine);
    expect_light(seen("diffuse 0.6, 0.3", side), paint * 0.6 * cosine);
    expect_light(seen("diffuse 0.6 brilliance 2", side), paint * 0.6 * cosine * cosine);
  }
}

TEST(Diffuse, SeesBothSidesOfASurface) {
  // The camera behind the plane: its normal is the one that points to the eye.
  Vec3 eye = place(30), at = place(40, 70);
  eye.z = -eye.z;
  auto const seen = [&] { return look(eye) + plane(finish("ambient 0 diffuse 0.6")) + lamp(at); };
  expect_light(seen(), Vec3(0));
  at.z = -at.z;
  expect_light(seen(), paint * 0.6 * std::cos(radians(40)));
}

TEST(Lamps, AddUp) {
  Vec3 const first(0.5, 0.25, 1), second(0.125, 1, 0.5), third(1, 0, 0);
  expect_light(
      look(place(15)) + plane(finish("ambient 0.1 diffuse 0.6")) + lamp(place(20), first)
          + lamp(place(70, 200), second) + lamp(-place(0), third), // behind
      paint * (0.1 + 0.6 * (first * std::cos(radians(20)) + second * std::cos(radians(70)))));
}

TEST(Lamps, MayTakeLightAway) {
  // Colours of lamps may be negative, as in POV-Ray.
  expect_light(look(place(15)) + plane(finish("ambient 0 diffuse 0.6")) + lamp(place(20), white)
                   + lamp(place(60, 90), {-0.5, -0.25, 0}),
               paint * 0.6
                   * (std::cos(radians(20)) + std::cos(radians(60)) * Vec3(-0.5, -0.25, 0)));
}

} // namespace
} // namespace abbe::physics
