// SPDX-License-Identifier: MIT
#include "transport/cameras/camera.hpp"
#include "transport/cameras/lens.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace abbe::transport::testing {
namespace {

using Kind = scene::Camera::Kind;
constexpr double tolerance = 1e-15;

/// Neither at right angles nor of one length.
scene::Camera skewed(Kind kind) {
  scene::Camera camera;
  camera.kind = kind;
  camera.location = {7, -8, 9};
  camera.direction = {0.3, -0.2, 2};
  camera.up = {0.1, 1.2, 0.2};
  camera.right = {1.6, 0.1, -0.3};
  return camera;
}

struct CameraRays {
  std::vector<Vec3> origins, directions;
};
CameraRays rays_of(scene::Camera const& camera, std::vector<Vec2> const& points, int width,
                   int height) {
  std::size_t const count = points.size();
  constexpr double untouched = -77;
  std::vector<double> x, y, values[6];
  for (Vec2 const& point : points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  for (auto& own : values) own.assign(count + 8, untouched);
  auto const at = [&](std::size_t i) {
    return geometry::VectorArrays{values[i].data(), values[i + 1].data(), values[i + 2].data()};
  };
  make_camera(camera)->rays({x.data(), y.data(), count, width, height}, at(0), at(3));
  for (auto const& own : values)
    for (std::size_t k = count; k < count + 8; ++k) EXPECT_EQ(own[k], untouched);
  CameraRays out;
  for (std::size_t k = 0; k < count; ++k) {
    out.origins.push_back(at(0).get(k));
    out.directions.push_back(at(3).get(k));
  }
  return out;
}

/// As many points as asked for, the corners and the middle first.
std::vector<Vec2> points_of(std::size_t count) {
  std::vector<Vec2> points{{0, 0}, {32, 0}, {0, 24}, {32, 24}, {16, 12}};
  for (std::size_t k = points.size(); k < count; ++k)
    points.emplace_back(0.37 * double(k), 0.59 * double(k));
  points.resize(count);
  return points;
}

Vec3 on_plane(scene::Camera const& camera, Vec2 const& point) {
  return (point.x / 32 - 0.5) * camera.right + (0.5 - point.y / 24) * camera.up;
}

void expect_near(Vec3 const& a, Vec3 const& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(PerspectiveCamera, RaysGoThroughThePictureFromOnePoint) {
  auto const camera = skewed(Kind::Perspective);
  EXPECT_TRUE(make_camera(camera)->has_one_point());
  EXPECT_EQ(make_camera(camera)->location(), camera.location);
  for (std::size_t const count : {1, 5, 16, 23}) {
    auto const points = points_of(count);
    auto const rays = rays_of(camera, points, 32, 24);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(rays.origins[k], Vec3(0)); // relative to the location
      expect_near(rays.directions[k],
                  glm::normalize(camera.direction + on_plane(camera, points[k])));
    }
  }
}

TEST(PerspectiveCamera, TheMiddleIsItsDirectionAndUpIsUp) {
  scene::Camera camera; // POV-Ray's
  camera.location = {1, 2, 3};
  auto const rays = rays_of(camera, {{16, 12}, {16, 0}, {32, 12}}, 32, 24);
  EXPECT_EQ(rays.directions[0], Vec3(0, 0, 1));
  expect_near(rays.directions[1], glm::normalize(Vec3(0, 0.5, 1)));
  expect_near(rays.directions[2], glm::normalize(Vec3(1.33 / 2, 0, 1)));
}

TEST(OrthographicCamera, RaysAreSideBySide) {
  auto const camera = skewed(Kind::Orthographic);
  EXPECT_FALSE(make_camera(camera)->has_one_point());
  for (std::size_t const count : {1, 5, 16, 23}) {
    auto const points = points_of(count);
    auto const rays = rays_of(camera, points, 32, 24);
    for (std::size_t k = 0; k < count; ++k) {
      expect_near(rays.origins[k], on_plane(camera, points[k]));
      expect_near(rays.directions[k], glm::normalize(camera.direction));
    }
  }
}

TEST(Cameras, ARayDoesNotDependOnHowManyThereAre) {
  for (Kind const kind : {Kind::Perspective, Kind::Orthographic}) {
    auto const points = points_of(40);
    auto const all = rays_of(skewed(kind), points, 32, 24);
    for (std::size_t k = 0; k < points.size(); ++k) {
      auto const alone = rays_of(skewed(kind), {points[k]}, 32, 24);
      EXPECT_EQ(alone.origins[0], all.origins[k]);
      EXPECT_EQ(alone.directions[0], all.directions[k]);
    }
  }
}

TEST(Footprint, OfAPixelGrowsWithTheDistanceWhereRaysComeFromOnePoint) {
  scene::Camera camera;
  camera.right = {4, 0, 0};
  camera.up = {0, 3, 0};
  camera.direction = {0, 0, 2};
  // A pixel is 4 / 40 wide and 3 / 60 high, at distance 2.
  auto const perspective = make_camera(camera)->footprint(40, 60);
  EXPECT_DOUBLE_EQ(perspective.at({0, 6, 8}), 10 * 0.05 / 2);
  camera.kind = Kind::Orthographic;
  auto const side_by_side = make_camera(camera)->footprint(40, 60);
  EXPECT_DOUBLE_EQ(side_by_side.at({0, 6, 8}), 0.05);
  EXPECT_DOUBLE_EQ(side_by_side.at(Vec3(0)), 0.05);
}

TEST(Footprint, OfACameraThatSeesAlongAPlaneIsThatOfItsOtherSide) {
  scene::Camera camera;
  camera.right = {4, 0, 0};
  camera.up = Vec3(0);
  EXPECT_DOUBLE_EQ(pixel_size(camera, 40, 10), 0.1);
  camera.up = {0, 2, 0};
  camera.right = Vec3(0);
  EXPECT_DOUBLE_EQ(pixel_size(camera, 40, 10), 0.2);
}

/// At right angles, of lengths other than 1.
scene::Camera upright(Kind kind) {
  scene::Camera camera;
  camera.kind = kind;
  camera.direction = {0, 0, 2};
  camera.up = {0, 1.5, 0};
  camera.right = {4.0 / 3, 0, 0};
  return camera;
}

/// Of one point of a picture of 1 x 1.
Vec3 direction_at(scene::Camera const& camera, double a, double b) {
  return rays_of(camera, {{a + 0.5, 0.5 - b}}, 1, 1).directions.front();
}

constexpr double degree = std::numbers::pi / 180;

TEST(CurvedCameras, LookAheadInTheMiddle) {
  for (auto const kind : {Kind::Fisheye, Kind::UltraWideAngle, Kind::Omnimax, Kind::Panoramic,
                          Kind::Cylinder, Kind::Spherical}) {
    Vec3 const ahead = direction_at(upright(kind), 0, 0);
    EXPECT_NEAR(ahead.x, 0, 1e-15);
    EXPECT_NEAR(ahead.y, 0, 1e-15);
    EXPECT_NEAR(ahead.z, 1, 1e-15);
  }
}

TEST(CurvedCameras, AFisheyesAngleGrowsWithTheDistanceFromTheMiddle) {
  auto camera = upright(Kind::Fisheye);
  camera.angle_deg = 140;
  for (double const a : {0.1, 0.2, 0.37}) {
    Vec3 const d = direction_at(camera, a, 0);
    EXPECT_NEAR(std::atan2(d.x, d.z), 2 * a * 4 / 3 * 70 * degree, 1e-14);
  }
  EXPECT_EQ(direction_at(camera, 0.4, 0), Vec3(0)); // 2 x 0.4 x 4/3 > 1
}

TEST(CurvedCameras, ASphericalOneShowsLongitudeAndLatitude) {
  auto camera = upright(Kind::Spherical);
  camera.angle_deg = 200;
  camera.vertical_angle_deg = 100;
  Vec3 const d = direction_at(camera, 0.3, -0.2);
  EXPECT_NEAR(std::atan2(d.x, d.z), 60 * degree, 1e-14);
  EXPECT_NEAR(std::asin(d.y), -20 * degree, 1e-14);
}

TEST(CurvedCameras, APanoramaIsHalfATurnWide) {
  auto camera = upright(Kind::Panoramic);
  camera.direction = {0, 0, 1};
  camera.up = {0, 1, 0};
  camera.right = {1, 0, 0};
  Vec3 const d = direction_at(camera, 0.25, 0.1);
  EXPECT_NEAR(std::atan2(d.x, d.z), 45 * degree, 1e-14);
  EXPECT_NEAR(std::atan2(d.y, std::hypot(d.x, d.z)), 18 * degree, 1e-14);
}

TEST(CurvedCameras, CylindersTurnAboutOneAxis) {
  auto camera = upright(Kind::Cylinder);
  camera.angle_deg = 100;
  camera.cylinder_type = 1;
  Vec3 const d = direction_at(camera, 0.25, 0.2);
  EXPECT_NEAR(std::atan2(d.x, d.z), 25 * degree, 1e-14);
  EXPECT_NEAR(d.y / std::hypot(d.x, d.z), 0.3, 1e-14);
  camera.cylinder_type = 4;
  EXPECT_FALSE(make_camera(camera)->has_one_point());
  auto const rays = rays_of(camera, {{0.75, 0.3}}, 1, 1);
  EXPECT_NEAR(rays.origins.front().x, 0.25 * 4 / 3, 1e-15);
  EXPECT_NEAR(std::atan2(rays.directions.front().y, rays.directions.front().z), 20 * degree, 1e-14);
}

TEST(CurvedCameras, AnOmnimaxLensIsCutOffBelow) {
  auto const camera = upright(Kind::Omnimax);
  EXPECT_GT(direction_at(camera, 0, 0.4).y, 0.5);
  EXPECT_EQ(direction_at(camera, 0, -0.4), Vec3(0));
  double const r = 0.6, theta = 1.411269 * r - 0.09439 * r * r * r + 0.25674 * std::pow(r, 5);
  Vec3 const d = direction_at(camera, 0.3, 0);
  EXPECT_NEAR(std::atan2(d.x, d.z), theta, 1e-14);
}

TEST(Lens, RaysAreEnoughByAChiSquaredTest) {
  scene::Camera camera;
  camera.aperture = 1;
  camera.blur_samples = 100;
  camera.blur_variance = 1.0 / 128;
  camera.blur_confidence = 0.9;
  Lens const lens = *Lens::of(camera);
  EXPECT_EQ(lens.next_rays(0), 25u);
  EXPECT_EQ(lens.next_rays(25), 12u);
  EXPECT_EQ(lens.next_rays(90), 10u);
  // What a tenth of all is below, of 7 and 19 degrees of freedom: 2.833 and 11.651 (tables).
  EXPECT_TRUE(lens.enough(8, 0.98 * 2.833 * 8 / 128));
  EXPECT_FALSE(lens.enough(8, 1.02 * 2.833 * 8 / 128));
  EXPECT_TRUE(lens.enough(20, 0.98 * 11.651 * 20 / 128));
  EXPECT_FALSE(lens.enough(20, 1.02 * 11.651 * 20 / 128));
  // Where all rays show the same, more say nothing; else variance 0 takes all.
  camera.blur_variance = 0;
  EXPECT_TRUE(Lens::of(camera)->enough(8, 0));
  EXPECT_FALSE(Lens::of(camera)->enough(99, 1e-9));
}

} // namespace
} // namespace abbe::transport::testing
