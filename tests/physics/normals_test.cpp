// SPDX-License-Identifier: MIT
// Normals of maps, seen as the brightness of a plane that a distant lamp lights: the cosine between
// the tilted normal and the way to the lamp.
#include "pixel.hpp"

namespace abbe::physics {
namespace {

/// The plane z = 0 at the point (x, 0), lit along a direction; its normal is -z.
double brightness(std::string const& normal, double x, Vec3 const& to_lamp,
                  std::string const& before = "") {
  Vec3 const lamp = 1e6 * glm::normalize(to_lamp);
  std::string const body =
      before + "camera { orthographic location <" + fmt::format("{}", x)
      + ", 0, -5> right 1e-6*x up 1e-6*y direction z }"
        "light_source { "
      + text(lamp)
      + ", rgb 1 parallel point_at 0 }"
        "plane { -z, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } normal { "
      + normal + " } }";
  image::Image const image = picture(body);
  return pixel(image, 0, 0).x;
}

Vec3 const in_front(0, 0, -1), from_the_side(0.6, 0, -0.8);

/// The cosine for a normal that a height tilts by `slope` along x.
double cosine(double slope, Vec3 const& to_lamp) {
  Vec3 const normal = glm::normalize(Vec3(-slope, 0, -1));
  return std::max(0.0, glm::dot(normal, glm::normalize(to_lamp)));
}

// Corners of a tetrahedron tilt by 5 a (4/3) times the slope of the value: their sum of squares.
// The four unit vectors t of the pattern's probe: sum of t t^T = 4/3 of the unit matrix.
double tilt(double amount, double slope) {
  return 5 * amount * 0.02 * slope * 4 / 3;
}

TEST(Normals, AGradientTiltsByItsSlope) {
  for (Vec3 const& lamp : {in_front, from_the_side})
    EXPECT_NEAR(brightness("gradient x, 2 scale 4", 1.3, lamp), cosine(tilt(2, 1), lamp), 1e-6);
}
TEST(Normals, ASlopeMapTiltsByItsOwnSlope) {
  // From height 0 at value 0 to height 1 at value 1 with slopes 1: the value itself.
  for (Vec3 const& lamp : {in_front, from_the_side}) {
    EXPECT_NEAR(brightness("gradient x, 2 slope_map { [0 <0, 1>] [1 <1, 1>] } scale 4", 1.3, lamp),
                cosine(tilt(2, 1), lamp), 1e-6);
    // A level piece between equal heights does not tilt.
    EXPECT_NEAR(
        brightness("gradient x, 2 slope_map { [0 <.5, 0>] [1 <.5, 0>] } scale 4", 1.3, lamp),
        cosine(0, lamp), 1e-6);
  }
}
TEST(Normals, ANormalMapMixesTiltedNormals) {
  // Half of a tilted normal and of one that is not: at the value 0.5.
  Vec3 const tilted = glm::normalize(Vec3(-tilt(2, 1), 0, -1));
  Vec3 const mixed = glm::normalize(0.5 * tilted + 0.5 * Vec3(0, 0, -1));
  for (Vec3 const& lamp : {in_front, from_the_side})
    EXPECT_NEAR(brightness("gradient y normal_map { [0 gradient x, 2 scale 4] [1 gradient x, 0] } "
                           "translate -.5*y",
                           1.3, lamp),
                glm::dot(mixed, glm::normalize(lamp)), 1e-4);
}
TEST(Normals, EntriesOfMapsBeginWithTheDefault) {
  std::string const map = "gradient y normal_map { [0 gradient x scale 4] [1 gradient x scale 4] }";
  EXPECT_NEAR(brightness(map, 1.3, from_the_side), cosine(tilt(0.5, 1), from_the_side), 1e-6);
  EXPECT_NEAR(brightness(map, 1.3, from_the_side, "#default { normal { bump_size 1.5 } }\n"),
              cosine(tilt(1.5, 1), from_the_side), 1e-6);
}

} // namespace
} // namespace abbe::physics
