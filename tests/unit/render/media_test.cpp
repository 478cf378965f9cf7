// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

/// Which medium a ray is in, measured by what it absorbs: exp(-length / depth) by Beer's law. The
/// pixel looks along +z, from the origin where nothing else is said. A scene with a priority
/// somewhere is one of bodies; without one, interiors are POV-Ray's.
namespace abbe::render::testing {
namespace {

constexpr double tolerance = 1e-6; // pixels are floats

/// Clear, with an index of 1: no ray is bent, none is reflected.
scene::Object medium(geometry::PlacedShape placed, double depth, int priority = 0) {
  scene::Object out = object(std::move(placed.shape), placed.placement, clear());
  auto interior = std::make_shared<scene::Interior>();
  if (depth > 0) {
    interior->fade_distance = depth;
    interior->fade_power = 1000; // exponential
  }
  interior->priority = priority;
  out.interior = interior;
  return out;
}
geometry::PlacedShape slab(double from, double to) {
  return *geometry::make_box({-50, -50, from}, {50, 50, to});
}
geometry::PlacedShape ball(double radius) {
  return *geometry::make_sphere(Vec3(0), radius);
}

/// What comes along the axis from a white surround.
double seen(std::vector<scene::Object> objects, Vec3 const& eye = Vec3(0)) {
  scene::Scene scene;
  scene.objects.assign(objects.begin(), objects.end());
  scene.background.rgb = Vec3(1);
  scene.camera.location = eye;
  scene.settings.assumed_gamma = 1;
  RenderOptions options;
  options.width = options.height = 1;
  return static_cast<double>(picture(scene, options).rgb[1]);
}

TEST(Media, HigherPriorityDisplacesWhatOverlaps) {
  // Wall from 1 to 5, water from 3 to 7: they share 2.
  EXPECT_NEAR(seen({medium(slab(1, 5), 0, 1), medium(slab(3, 7), 2)}), std::exp(-1.0), tolerance);
  // The same when the water is entered first: its surface inside the wall is not there.
  EXPECT_NEAR(seen({medium(slab(3, 7), 0, 1), medium(slab(1, 5), 2)}), std::exp(-1.0), tolerance);
  // A wall within the water: the water's two parts are apart.
  EXPECT_NEAR(seen({medium(slab(3, 4), 0, 1), medium(slab(1, 7), 2)}), std::exp(-2.5), tolerance);
  // Water all within the wall is not there.
  EXPECT_NEAR(seen({medium(slab(1, 7), 0, 1), medium(slab(3, 4), 2)}), 1, tolerance);
  EXPECT_NEAR(seen({medium(slab(1, 7), 0), medium(slab(3, 4), 2, -1)}), 1, tolerance);
}

/// Makes the scene one of bodies.
scene::Object elsewhere() {
  return medium(*geometry::make_sphere(Vec3(0, 0, -300), 1), 0, 1);
}

TEST(Media, OfEqualPriorityTheLaterEnteredCounts) {
  EXPECT_NEAR(seen({medium(slab(1, 5), 0), medium(slab(3, 7), 2), elsewhere()}), std::exp(-2.0),
              tolerance);
  EXPECT_NEAR(seen({medium(slab(3, 7), 0), medium(slab(1, 5), 2), elsewhere()}), std::exp(-1.0),
              tolerance);
}

/// As measured with POV-Ray: where a surface ends its interior, what that takes on the way from
/// the surface before.
TEST(Media, PlainInteriorsFadeFromTheLastSurfaceToTheirOwn) {
  EXPECT_NEAR(seen({medium(slab(1, 5), 0), medium(slab(3, 7), 2)}), std::exp(-1.0), tolerance);
  EXPECT_NEAR(seen({medium(slab(1, 5), 4), medium(slab(3, 7), 2)}), std::exp(-2 / 4.0 - 1),
              tolerance);
  // A sheet without an interior is a surface too.
  auto sheet = medium(*geometry::make_disc({0, 0, 4}, {0, 0, 1}, 5, 0), 0);
  sheet.interior.reset();
  EXPECT_NEAR(seen({medium(slab(1, 5), 2), sheet}), std::exp(-1 / 2.0), tolerance);
}

scene::Object combined(scene::Object::Kind kind, std::vector<scene::Object> parts,
                       std::shared_ptr<scene::Interior const> interior) {
  scene::Object out;
  out.kind = kind;
  out.interior = std::move(interior);
  for (auto& part : parts)
    if (!part.interior) part.interior = out.interior;
  out.children = std::move(parts);
  return out;
}

TEST(Media, PartsOfACombinationShareItsInterior) {
  using Kind = scene::Object::Kind;
  auto const part = [](double from, double to) {
    auto out = medium(slab(from, to), 0);
    out.interior.reset();
    return out;
  };
  auto const dark = medium(ball(1), 2).interior;
  EXPECT_NEAR(seen({combined(Kind::Union, {part(1, 5), part(3, 7)}, dark)}), std::exp(-3.0),
              tolerance);
  EXPECT_NEAR(seen({combined(Kind::Merge, {part(1, 5), part(3, 7)}, dark)}), std::exp(-3.0),
              tolerance);
  EXPECT_NEAR(seen({combined(Kind::Intersection, {part(1, 5), part(3, 7)}, dark)}), std::exp(-1.0),
              tolerance);
  EXPECT_NEAR(seen({combined(Kind::Difference, {part(1, 5), part(3, 7)}, dark)}), std::exp(-1.0),
              tolerance);
  // One that is entered by one part and left by another, which has an interior of its own or
  // none, stays open.
  auto const other = [&](double from, double to) { return medium(slab(from, to), 4); };
  for (auto const kind : {Kind::Merge, Kind::Difference, Kind::Intersection}) {
    EXPECT_NEAR(seen({combined(kind, {part(1, 5), other(3, 7)}, dark)}), 1, tolerance);
    EXPECT_NEAR(seen({combined(kind, {part(3, 7), other(1, 5)}, nullptr)}), 1, tolerance);
  }
}

TEST(Media, ADisplacedSurfaceHasNoTexture) {
  auto water = medium(slab(3, 7), 0);
  water.texture = plain(Vec3(0)); // black: seen where it is not displaced
  EXPECT_NEAR(seen({medium(slab(1, 8), 0, 1), water}), 1, tolerance);
  EXPECT_NEAR(seen({medium(slab(1, 8), 0), water}), 0, tolerance);
}

TEST(Media, FadingIsMeasuredAcrossDisplacedSurfaces) {
  // Not exponential: 1 / (1 + (d / D)^2) of all 6 units, not of 2 and 4.
  auto wall = medium(slab(1, 7), 0, 1);
  auto interior = std::make_shared<scene::Interior>(*wall.interior);
  interior->fade_distance = 3;
  interior->fade_power = 2;
  wall.interior = interior;
  EXPECT_NEAR(seen({wall, medium(slab(3, 4), 0)}), 1 / (1 + 4.0), tolerance);
}

TEST(Media, CameraInsideNestedGlassKnowsWhereItIs) {
  EXPECT_NEAR(seen({medium(ball(3), 2)}), std::exp(-1.5), tolerance);
  EXPECT_NEAR(seen({medium(ball(1), 5), medium(ball(3), 2)}), std::exp(-1 / 5.0 - 1), tolerance);
  EXPECT_NEAR(seen({medium(ball(3), 2), medium(ball(1), 5)}), std::exp(-1 / 5.0 - 1), tolerance);
  // The outer one by priority, and a third around both.
  EXPECT_NEAR(seen({medium(ball(3), 2, 1), medium(ball(1), 5)}), std::exp(-1.5), tolerance);
  EXPECT_NEAR(seen({medium(ball(1), 5, 2), medium(ball(3), 2, 1), medium(ball(4), 1)}),
              std::exp(-1 / 5.0 - 1 - 1), tolerance);
}

TEST(Media, CameraInAHoleIsInAir) {
  auto const shell = [](int priority) {
    scene::Object out;
    out.kind = scene::Object::Kind::Difference;
    out.children = std::vector{medium(ball(3), 2, priority), medium(ball(1), 2, priority)};
    out.interior = out.children[0].interior;
    return out;
  };
  EXPECT_NEAR(seen({shell(0), elsewhere()}), std::exp(-1.0), tolerance);
  // In a hole of glass that stands in another glass.
  EXPECT_NEAR(seen({shell(1), medium(ball(4), 5)}), std::exp(-1 / 5.0 - 1 - 1 / 5.0), tolerance);
}

TEST(Media, CameraInABoundlessMedium) {
  // Half a world of water, surface at z = 2.
  EXPECT_NEAR(seen({medium(*geometry::make_plane({0, 0, 1}, 2), 4)}), std::exp(-0.5), tolerance);
}

/// A lamp, and a white wall at z = 8 that it lights straight on.
double lit(std::vector<scene::Object> objects, Vec3 const& lamp) {
  scene::Scene scene;
  scene::Light light;
  light.position = lamp;
  light.colour.rgb = Vec3(1);
  scene.lights = {light};
  auto const wall = *geometry::make_plane({0, 0, -1}, -8);
  scene.objects.assign(objects.begin(), objects.end());
  scene.objects.push_back(object(wall.shape, wall.placement, plain(Vec3(1))));
  scene.objects.back().texture->front().finish->ambient.rgb = Vec3(0);
  scene.objects.back().texture->front().finish->diffuse = 1;
  scene.camera.location = {0, 0, 7.5};
  scene.settings.assumed_gamma = 1;
  RenderOptions options;
  options.width = options.height = 1;
  return static_cast<double>(picture(scene, options).rgb[1]);
}

TEST(Media, LampsInsideGlassSendThroughIt) {
  EXPECT_NEAR(lit({}, Vec3(0)), 1, tolerance);
  EXPECT_NEAR(lit({medium(ball(3), 2), elsewhere()}, Vec3(0)), std::exp(-1.5), tolerance);
  EXPECT_NEAR(lit({medium(ball(1), 5), medium(ball(3), 2), elsewhere()}, Vec3(0)),
              std::exp(-1 / 5.0 - 1), tolerance);
  // In POV-Ray, only what a surface ends fades, also towards a lamp.
  EXPECT_NEAR(lit({medium(ball(3), 2)}, Vec3(0)), 1, tolerance);
  EXPECT_NEAR(lit({medium(ball(1), 5), medium(ball(3), 2, 1)}, Vec3(0)), std::exp(-1.5), tolerance);
}

TEST(Media, LampsOnAPaneAreNotBehindIt) {
  // From the wall straight to the lamp, which lies on the near face of a dark pane: many places,
  // since roundings decide on which side of the lamp the face is met.
  for (int i = 0; i < 200; ++i) {
    auto pane = medium(slab(1, 3), 0);
    pane.texture = plain(Vec3(1), 0.5);
    Vec3 const lamp(0.013 * i, -0.007 * i, 3);
    EXPECT_EQ(lit({pane}, lamp), lit({}, lamp)) << i;
    EXPECT_LT(lit({pane}, lamp - Vec3(0, 0, 1e-9)), 0.6 * lit({}, lamp)) << i;
  }
}

/// A disc across the axis that the pixel looks along, at z.
scene::Object sheet(double z, double side, std::shared_ptr<scene::Interior const> interior) {
  auto out = medium(*geometry::make_disc({0, 0, z}, {0, 0, side}, 5, 0), 0);
  out.interior = std::move(interior);
  return out;
}

TEST(Media, SheetsAreEnteredFromOutsideAndLeftFromInside) {
  auto const interior = medium(ball(1), 2).interior;
  for (double const near : {-1.0, 1.0}) // which side a normal points to makes no difference
    for (double const far : {-1.0, 1.0})
      EXPECT_NEAR(seen({sheet(2, near, interior), sheet(5, far, interior), elsewhere()}),
                  std::exp(-1.5), tolerance);
  // Not of one interior: both are entered, and only what rules is left.
  auto const other = medium(ball(1), 4).interior;
  EXPECT_NEAR(seen({sheet(2, -1, interior), sheet(3, -1, other), sheet(7, 1, other),
                    sheet(9, 1, interior), elsewhere()}),
              std::exp(-0.5 - 1 - 1), tolerance);
}

TEST(Media, SheetsOfAUnionShareItsInterior) {
  auto const interior = medium(ball(1), 2).interior;
  auto const both = [&](double near, double far) {
    return combined(scene::Object::Kind::Union, {sheet(2, near, nullptr), sheet(5, far, nullptr)},
                    interior);
  };
  for (double const near : {-1.0, 1.0})
    for (double const far : {-1.0, 1.0})
      EXPECT_NEAR(seen({both(near, far)}), std::exp(-1.5), tolerance);
  // Two objects with the same interior have one each: both stay open.
  EXPECT_NEAR(seen({sheet(2, 1, interior), sheet(5, 1, interior)}), 1, tolerance);
}

TEST(Media, ClippedSolidsAreEnteredWhereTheyAreFirstMet) {
  // The far half of a ball from 3 to 5, in front of a sheet of the same interior at 7.
  auto half = medium(*geometry::make_sphere({0, 0, 4}, 1), 2);
  half.clipped_by = {medium(slab(4, 9), 0)};
  EXPECT_NEAR(seen({half, sheet(7, 1, half.interior), elsewhere()}), std::exp(-1.0), tolerance);
  // In POV-Ray each has its own: what the half was entered by is all there is of it.
  EXPECT_NEAR(seen({half, sheet(7, 1, half.interior)}), 1, tolerance);
  half.clipped_by = {medium(slab(3.5, 4.5), 0)};
  EXPECT_NEAR(seen({half}), 1, tolerance);
  half.clipped_by = {medium(slab(1, 9), 0)};
  EXPECT_NEAR(seen({half}), std::exp(-1.0), tolerance);
}

/// A cube from 1 to 5 in depth, as a mesh; `missing` triangles are left out from the end, which is
/// the far side.
scene::Object mesh_cube(double depth, std::size_t missing) {
  geometry::MeshData data;
  for (int i = 0; i < 8; ++i) {
    data.vertices.push_back({i & 1 ? 2 : -2, i & 2 ? 2 : -2, i & 4 ? 5 : 1});
  }
  data.faces = {{0, 1, 3}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6},
                {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}, {4, 5, 7}, {4, 7, 6}};
  data.faces.resize(data.faces.size() - missing);
  data.inside_vector = Vec3(0, 1, 0);
  return medium(*geometry::make_mesh(std::move(data)).shape, depth);
}

/// As bodies.
double seen_bodies(std::vector<scene::Object> objects, Vec3 const& eye) {
  objects.push_back(elsewhere());
  return seen(std::move(objects), eye);
}

TEST(Media, OpenMeshesAreNotLeftWhereTheyHaveNoFace) {
  EXPECT_NEAR(seen({mesh_cube(2, 0)}, {.1, .3, 0}), std::exp(-2.0), tolerance);
  EXPECT_NEAR(seen({mesh_cube(2, 2)}, {.1, .3, 0}), 1, tolerance);
  EXPECT_NEAR(seen({mesh_cube(2, 2), medium(slab(20, 23), 3)}, {.1, .3, 0}), std::exp(-1.0), 1e-5);
  EXPECT_NEAR(seen({mesh_cube(2, 1)}, {.3, .1, 0}), std::exp(-2.0), 1e-5);
  EXPECT_NEAR(seen({mesh_cube(2, 1)}, {.1, .3, 0}), 1, 1e-5);
}

TEST(Media, OpenMeshesAreLeftAtTheirBounds) {
  EXPECT_NEAR(seen_bodies({mesh_cube(2, 0)}, {.1, .3, 0}), std::exp(-2.0), tolerance);
  // Out through the hole: to the sky, and to a medium behind, of which all is seen.
  EXPECT_NEAR(seen_bodies({mesh_cube(2, 2)}, {.1, .3, 0}), std::exp(-2.0), 1e-5);
  EXPECT_NEAR(seen_bodies({mesh_cube(2, 2), medium(slab(20, 23), 3)}, {.1, .3, 0}), std::exp(-3.0),
              1e-5);
  // The half of the far side that is there is a surface like any other.
  EXPECT_NEAR(seen_bodies({mesh_cube(2, 1), medium(slab(20, 23), 3)}, {.3, .1, 0}), std::exp(-3.0),
              1e-5);
  EXPECT_NEAR(seen_bodies({mesh_cube(2, 1), medium(slab(20, 23), 3)}, {.1, .3, 0}), std::exp(-3.0),
              1e-5);
  // Towards a lamp, in through the hole: what looks like the way in ends at the bounds at once.
  Vec3 const lamp(.1, .1, -1);
  EXPECT_NEAR(lit({mesh_cube(2, 0), elsewhere()}, lamp), lit({}, lamp) * std::exp(-2.0), 1e-4);
  EXPECT_NEAR(lit({mesh_cube(2, 2), elsewhere()}, lamp), lit({}, lamp), 1e-5);
}

} // namespace
} // namespace abbe::render::testing
