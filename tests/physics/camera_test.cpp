// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <array>

/// Where in the picture things are seen. A luminous ball is so small that it is met only by a ray
/// that goes through its very middle: the ray of one pixel.
namespace abbe::physics {
namespace {

constexpr int width = 40, height = 30;
/// Of a ball, beside its distance from the eye.
constexpr double size = 1e-9;

struct At {
  int x, y;
  /// Across and up from the middle of the picture, -1 to 1 at its edges.
  double across() const { return 2 * (x + 0.5) / width - 1; }
  double up() const { return 1 - 2 * (y + 0.5) / height; }
};
constexpr std::array<At, 7> places{
    {{0, 0}, {39, 0}, {0, 29}, {39, 29}, {20, 15}, {7, 22}, {31, 4}}};

/// Expects the ball in this pixel, and in no other.
void expect_ball(std::string const& camera, Vec3 const& at, double distance, At const& place) {
  std::string const body =
      camera
      + fmt::format(
          "sphere {{ {}, {:.17g} pigment {{ rgb 1 }} finish {{ ambient 1 diffuse 0 }} }}\n",
          text(at), size * distance);
  auto const image = picture(body, width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      EXPECT_EQ(pixel(image, x, y), Vec3(x == place.x && y == place.y ? 1 : 0))
          << "pixel " << x << ", " << y << " of\n"
          << body;
}

/// A frame of unit vectors by hand.
struct Frame {
  Vec3 eye, forward, right, up;
};
/// Expects the balls that perspective puts at the places, at several distances.
/// @param half the tangents of half the angles of the picture, across and down
void expect_perspective(std::string const& camera, Frame const& frame, double half_across,
                        double half_up) {
  double depth = 0.5;
  for (At const& place : places) {
    Vec3 const offset = depth
                        * (frame.forward + place.across() * half_across * frame.right
                           + place.up() * half_up * frame.up);
    expect_ball(camera, frame.eye + offset, glm::length(offset), place);
    depth *= 3;
  }
}

TEST(Perspective, IsThatOfPovrayByDefault) {
  // From 0 along z, the picture 1.33 wide and 1 high at z = 1.
  expect_perspective("camera { }\n", {Vec3(0), {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 1.33 / 2, 0.5);
}

TEST(Perspective, HasDirectionUpAndRight) {
  expect_perspective("camera { location <1, 2, -3> direction 2*z up 0.75*y right 1.5*x }\n",
                     {{1, 2, -3}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 0.75 / 2, 0.375 / 2);
  // A right-handed one: mirrored.
  expect_perspective("camera { direction z right -x up y }\n",
                     {Vec3(0), {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}, 0.5, 0.5);
  // A skew one.
  expect_perspective("camera { direction <0, 0.25, 1> right <1, 0.5, 0> up <0.25, 1, 0> }\n",
                     {Vec3(0), {0, 0.25, 1}, {1, 0.5, 0}, {0.25, 1, 0}}, 0.5, 0.5);
}

TEST(Perspective, HasAnAngleAcross) {
  for (double const angle : {10.0, 60.0, 90.0, 150.0}) {
    double const half = std::tan(radians(angle / 2));
    expect_perspective(fmt::format("camera {{ angle {} right 4/3*x }}\n", angle),
                       {Vec3(0), {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, half, half * 0.75);
    // Whatever the length of the direction.
    expect_perspective(fmt::format("camera {{ direction 7*z up 2*y right 4*x angle {} }}\n", angle),
                       {Vec3(0), {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, half, half * 0.5);
  }
}

/// The frame of who looks from one point to another, his head towards the sky.
Frame looking(Vec3 const& from, Vec3 const& to, Vec3 const& sky = {0, 1, 0}) {
  Vec3 const forward = glm::normalize(to - from);
  Vec3 const right = glm::normalize(glm::cross(sky, forward));
  return {from, forward, right, glm::cross(forward, right)};
}

TEST(Perspective, LooksAtAPoint) {
  Vec3 const from(3, 4, -5), to(1, 0, 2);
  std::string const items = fmt::format("location {} look_at {} right 4/3*x", text(from), text(to));
  expect_perspective("camera { " + items + " }\n", looking(from, to), 2.0 / 3, 0.5);
  expect_perspective("camera { angle 50 " + items + " }\n", looking(from, to),
                     std::tan(radians(25)), std::tan(radians(25)) * 0.75);
  // What it looks at is in the middle of a picture of odd size.
  auto const image = picture("camera { " + items + " }\n"
                                 + fmt::format("sphere {{ {}, 1e-8 pigment {{ rgb 1 }} finish {{ "
                                               "ambient 1 }} }}\n",
                                               text(to)),
                             3, 3);
  EXPECT_EQ(pixel(image, 1, 1), Vec3(1));
  EXPECT_EQ(pixel(image, 0, 1), Vec3(0));
}

TEST(Perspective, HasItsHeadTowardsTheSky) {
  Vec3 const from(1, 2, 3), to(-2, 5, 1), sky(0.3, 0.2, 1);
  expect_perspective(fmt::format("camera {{ location {} look_at {} sky {} right x }}\n", text(from),
                                 text(to), text(sky)),
                     looking(from, to, sky), 0.5, 0.5);
  // Right-handed, as right is written.
  Frame mirror = looking(from, to, sky);
  mirror.right = -mirror.right;
  expect_perspective(fmt::format("camera {{ location {} look_at {} sky {} right -x }}\n",
                                 text(from), text(to), text(sky)),
                     mirror, 0.5, 0.5);
}

TEST(Perspective, IsTransformedAsAWhole) {
  // Turned by 90 degrees about y what looks along z looks along x, and its right is -z.
  expect_perspective("camera { location -2*z rotate 90*y translate <1, 2, 3> }\n",
                     {{-1, 2, 3}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 1.33 / 2, 0.5);
  expect_perspective("camera { location -z right x scale 3 }\n",
                     {{0, 0, -3}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 0.5, 0.5);
}

/// Expects the balls that parallel rays put at the places. @param half of the picture's size
void expect_orthographic(std::string const& camera, Frame const& frame, double half_across,
                         double half_up) {
  double depth = 0.5;
  for (At const& place : places) {
    Vec3 const offset = depth * frame.forward + place.across() * half_across * frame.right
                        + place.up() * half_up * frame.up;
    expect_ball(camera, frame.eye + offset, depth, place);
    depth *= 3;
  }
}

TEST(Orthographic, IsAsLargeAsRightAndUp) {
  expect_orthographic("camera { orthographic location <1, 2, -3> direction z right 6*x up 4*y }\n",
                      {{1, 2, -3}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 3, 2);
  Vec3 const from(3, 4, -5), to(1, 0, 2);
  expect_orthographic(fmt::format("camera {{ orthographic location {} look_at {} right 6*x up 4*y "
                                  "}}\n",
                                  text(from), text(to)),
                      looking(from, to), 3, 2);
}

TEST(Orthographic, GrowsWithTheDistanceOfWhatItLooksAt) {
  Vec3 const from(3, 4, -5), to(1, 0, 2);
  double const distance = glm::distance(from, to);
  expect_orthographic(
      fmt::format("camera {{ orthographic location {} look_at {} }}\n", text(from), text(to)),
      looking(from, to), 1.33 / 2 * distance, 0.5 * distance);
  // As wide at this distance as an angle.
  double const half = std::tan(radians(20)) * distance;
  expect_orthographic(fmt::format("camera {{ orthographic angle 40 location {} look_at {} right "
                                  "4/3*x }}\n",
                                  text(from), text(to)),
                      looking(from, to), half, half * 0.75);
}

TEST(Pictures, OfACheckeredFloorTellEveryPixel) {
  // From 3 above it, downwards at 40 degrees: where each ray meets the floor is computed here.
  double const down = radians(40);
  Vec3 const eye(0.3, 3, -7), forward(0, -std::sin(down), std::cos(down));
  Vec3 const up(0, std::cos(down), std::sin(down));
  auto const image = picture(fmt::format("camera {{ location {} look_at {} right 4/3*x }}\n",
                                         text(eye), text(eye + forward))
                                 + "plane { y, 0 pigment { checker rgb 0.25, rgb 0.75 } finish { "
                                   "ambient 1 diffuse 0 } }\n",
                             width, height);
  int met = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      At const at{x, y};
      Vec3 const way = forward + at.across() * 2 / 3 * Vec3(1, 0, 0) + at.up() * 0.5 * up;
      if (way.y >= 0) {
        EXPECT_EQ(pixel(image, x, y), Vec3(0));
        continue;
      }
      ++met;
      Vec3 const floor = eye - eye.y / way.y * way;
      bool const odd =
          (std::lround(std::floor(floor.x)) + std::lround(std::floor(floor.z))) % 2 != 0;
      EXPECT_EQ(pixel(image, x, y), Vec3(odd ? 0.75 : 0.25)) << x << ", " << y;
    }
  EXPECT_GT(met, width * height / 2);
}

} // namespace
} // namespace abbe::physics
