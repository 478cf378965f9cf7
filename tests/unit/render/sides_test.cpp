// SPDX-License-Identifier: MIT
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

/// Which of its textures a surface shows, to the eye and to light on its way to a wall.
namespace abbe::render::testing {
namespace {

constexpr double tolerance = 1e-6; // pixels are floats

/// Shines by itself, grey.
scene::Layers shining(double grey) {
  auto layers = plain(Vec3(grey));
  layers[0].finish->ambient.rgb = Vec3(1);
  layers[0].finish->diffuse = 0;
  return layers;
}

double pixel(scene::Scene const& scene) {
  RenderOptions options;
  options.width = options.height = 1;
  return static_cast<double>(picture(scene, options).rgb[1]);
}

/// What is seen along +z, x to the right and y up.
double seen(scene::Object const& object) {
  scene::Scene scene;
  scene.objects = {object};
  scene.settings.assumed_gamma = 1;
  return pixel(scene);
}

/// The share of a lamp's light that passes on its way along +z to a wall.
double passed(scene::Object const& object) {
  scene::Scene scene;
  scene::Light light;
  light.colour.rgb = Vec3(1);
  scene.lights = {light};
  auto const wall = *geometry::make_plane({0, 0, -1}, -8);
  auto white = plain(Vec3(1));
  white[0].finish->ambient.rgb = Vec3(0);
  white[0].finish->diffuse = 1;
  scene.objects = {testing::object(wall.shape, wall.placement, white), object};
  scene.camera.location = {0, 0, 7.5};
  scene.settings.assumed_gamma = 1;
  return pixel(scene);
}

/// A triangle at z = 4 whose corners run counter-clockwise as it is seen, or clockwise.
scene::Object triangle(bool clockwise, std::vector<Vec3> normals = {}, bool lone = false) {
  geometry::MeshData data;
  data.vertices = {{-3, -2, 4}, {3, -2, 4}, {0, 4, 4}};
  data.faces = {clockwise ? geometry::Corners{0, 2, 1} : geometry::Corners{0, 1, 2}};
  if (!normals.empty()) data.normal_corners = data.faces;
  data.normals = std::move(normals);
  data.lone = lone;
  auto const shape = *geometry::make_mesh(std::move(data)).shape;
  auto out = object(shape.shape, shape.placement, shining(0.75));
  out.interior_texture = shining(0.25);
  return out;
}

TEST(Sides, OfAFaceAreToldByItsWinding) {
  EXPECT_NEAR(seen(triangle(false)), 0.75, tolerance);
  EXPECT_NEAR(seen(triangle(true)), 0.25, tolerance);
  auto inverse = triangle(false);
  inverse.inverse = true;
  EXPECT_NEAR(seen(inverse), 0.25, tolerance);
}

TEST(Sides, OfASmoothedFaceAreToldByItsNormals) {
  for (bool const clockwise : {false, true}) {
    EXPECT_NEAR(seen(triangle(clockwise, {{.1, 0, -1}, {0, 0, -1}, {0, .1, -1}})), 0.75, tolerance);
    EXPECT_NEAR(seen(triangle(clockwise, {{.1, 0, 1}, {0, 0, 1}, {0, .1, 1}})), 0.25, tolerance);
  }
  // Equal normals smooth nothing.
  EXPECT_NEAR(seen(triangle(false, std::vector<Vec3>(3, {0, 0, 1}))), 0.75, tolerance);
}

TEST(Sides, OfATriangleAloneAreToldByItsLargestAxis) {
  EXPECT_NEAR(seen(triangle(false, {}, true)), 0.75, tolerance);
  EXPECT_NEAR(seen(triangle(true, {}, true)), 0.75, tolerance);
}

/// The same textures, as panes.
scene::Object pane(scene::Object surface) {
  surface.texture = plain(Vec3(1), 0.75);
  if (surface.interior_texture) surface.interior_texture = plain(Vec3(1), 0.25);
  return surface;
}

TEST(Sides, AreTheSameForShadows) {
  // From the wall to the lamp a ray goes along -z.
  EXPECT_NEAR(passed(pane(triangle(false))), 0.25, tolerance);
  EXPECT_NEAR(passed(pane(triangle(true))), 0.75, tolerance);
  for (double const side : {-1.0, 1.0}) {
    auto const disc = *geometry::make_disc({0, 0, 4}, {0, 0, side}, 3, 0);
    auto surface = object(disc.shape, disc.placement, plain(Vec3(1), 0.5));
    surface.interior_texture = plain(Vec3(1), 0.5);
    EXPECT_NEAR(passed(pane(surface)), side > 0 ? 0.75 : 0.25, tolerance);
  }
  auto const ball = *geometry::make_sphere({0, 0, 4}, 1);
  auto solid = object(ball.shape, ball.placement, plain(Vec3(1), 0.5));
  solid.interior_texture = plain(Vec3(1), 0.5);
  EXPECT_NEAR(passed(pane(solid)), 0.75 * 0.25, tolerance);
}

TEST(Sides, ShadowsAreOfTheTexturesOfFaces) {
  auto const faces = [](std::array<std::int32_t, 3> const& corners) {
    geometry::MeshData data;
    data.vertices = {{-3, -3, 4}, {3, -3, 4}, {0, 6, 4}};
    data.faces = {{0, 1, 2}};
    data.textures = {corners};
    auto const shape = *geometry::make_mesh(std::move(data)).shape;
    auto out = object(shape.shape, shape.placement, plain(Vec3(1)));
    out.face_textures = {plain(Vec3(1), 0.8), plain(Vec3(1), 0.5), plain(Vec3(1))};
    return out;
  };
  EXPECT_NEAR(passed(faces({0, 0, 0})), 0.8, tolerance);
  EXPECT_NEAR(passed(faces({-1, -1, -1})), 0, tolerance);
  EXPECT_NEAR(passed(faces({0, 1, 2})), (0.8 + 0.5 + 0) / 3, tolerance); // at the middle
}

TEST(Sides, CausticsGatherLightOnceALayer) {
  auto const through = [](double angle_rad, std::size_t layers, double caustics) {
    Vec3 const normal(std::sin(angle_rad), 0, -std::cos(angle_rad));
    auto const disc = *geometry::make_disc({0, 0, 4}, normal, 3, 0);
    auto surface = object(disc.shape, disc.placement, plain(Vec3(1), 0.5));
    for (std::size_t i = 1; i < layers; ++i) surface.texture->push_back(surface.texture->front());
    auto interior = std::make_shared<scene::Interior>();
    interior->caustics = caustics;
    surface.interior = interior;
    return passed(surface);
  };
  EXPECT_NEAR(through(0, 1, 0), 0.5, tolerance);
  EXPECT_NEAR(through(0, 1, 1), 0.5 * 2, tolerance);
  EXPECT_NEAR(through(0.3, 1, 0.2), 0.5 * (1 + std::pow(std::cos(0.3), 9)), tolerance);
  EXPECT_NEAR(through(0.3, 2, 0.2), std::pow(0.5 * (1 + std::pow(std::cos(0.3), 9)), 2), tolerance);
}

} // namespace
} // namespace abbe::render::testing
