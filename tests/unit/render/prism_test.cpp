// SPDX-License-Identifier: MIT
#include "geometry/shapes/plane.hpp"
#include "geometry/world.hpp"
#include "optics/data_library.hpp"
#include "optics/refract.hpp"
#include "scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace abbe::render::testing {
namespace {

/// Traces one ray of one wavelength through a solid in the way the renderer does: crossings of the
/// world, normals, Snell; returns the direction beyond `interfaces` interfaces.
Vec3 trace_through(geometry::World const& world, Vec3 const& origin, Vec3 direction, double n,
                   int interfaces) {
  auto const scratch = geometry::World::make_scratch();
  geometry::HitGroup hit;
  geometry::Departure from;
  geometry::Ray ray{origin, direction, Vec3(0)};
  for (int i = 0; i < interfaces; ++i) {
    bool const found = world.closest(ray, i == 0 ? nullptr : &from, 0xff,
                                     std::numeric_limits<double>::infinity(), *scratch, hit);
    if (!found || hit.crossings.empty()) {
      ADD_FAILURE() << "the ray met no interface " << i;
      return direction;
    }
    auto const& crossing = hit.crossings.front();
    Vec3 normal = world.normal(crossing.primitive, crossing.face, hit.point);
    if (glm::dot(normal, direction) > 0) normal = -normal;
    double const n1 = crossing.entering ? 1 : n;
    double const n2 = crossing.entering ? n : 1;
    Vec3 const cross = glm::cross(direction, normal);
    auto const face = optics::fresnel<double>(n1, n2, n2 - n1, -glm::dot(direction, normal),
                                              glm::dot(cross, cross));
    EXPECT_FALSE(face.total);
    direction = optics::refracted(face, direction, normal);
    from.on = hit.members;
    from.through = true;
    ray = {hit.point, direction, hit.point_error};
  }
  return direction;
}

/// A prism of apex angle `apex`, edge along z through the origin, opening downward.
geometry::World prism_world(double apex) {
  using geometry::CsgTree;
  std::vector<geometry::PlacedShape> primitives;
  CsgTree tree;
  tree.op = CsgTree::Op::Intersection;
  Vec3 const normals[] = {{std::cos(apex / 2), std::sin(apex / 2), 0},
                          {-std::cos(apex / 2), std::sin(apex / 2), 0}};
  for (auto const& normal : normals) {
    CsgTree leaf;
    leaf.primitive = static_cast<geometry::PrimitiveId>(primitives.size());
    auto plane = geometry::make_plane(normal, 0);
    ABBE_ASSERT(plane);
    primitives.push_back(*plane);
    tree.children.push_back(leaf);
  }
  return geometry::World(std::move(primitives), {{tree, 0xff}});
}

/// Sellmeier coefficients of twenty SCHOTT glasses (catalogue of 2023 by way of
/// refractiveindex.info).
struct Row {
  char const* name;
  double b[3], c[3];
};
constexpr Row glasses[] = {
    {"N-BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    {"N-SF11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
    {"F2", {1.34533359, 0.209073176, 0.937357162}, {0.00997743871, 0.0470450767, 111.886764}},
    {"SF10", {1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}},
    {"N-SF6", {1.77931763, 0.338149866, 2.08734474}, {0.0133714182, 0.0617533621, 174.01759}},
    {"N-BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    {"N-SK16", {1.34317774, 0.241144399, 0.994317969}, {0.00704687339, 0.0229005, 92.7508526}},
    {"N-LAK22", {1.14229781, 0.535138441, 1.04088385}, {0.00585778594, 0.0198546147, 100.834017}},
    {"N-FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    {"N-K5", {1.08511833, 0.199562005, 0.930511663}, {0.00661099503, 0.024110866, 111.982777}},
};

/// Twenty glasses: the ten above and, with each, the fictitious one of twice its resonances'
/// strength less one tenth, so that indices from 1.45 to 2.3 are covered.
std::vector<optics::GlassPtr> twenty_glasses() {
  std::vector<optics::GlassPtr> out;
  for (auto const& row : glasses)
    for (double const strength : {1.0, 1.35}) {
      std::vector<double> const b{strength * row.b[0], strength * row.b[1], strength * row.b[2]};
      out.push_back(sellmeier(row.name, b, {row.c[0], row.c[1], row.c[2]}));
    }
  return out;
}

TEST(Prism, DeviationIsLeastWhereTheorySaysAndExitAnglesAreAnalytic) {
  double const apex = 40 * std::numbers::pi / 180;
  auto const world = prism_world(apex);
  for (auto const& glass : twenty_glasses())
    for (double lambda_nm = 400; lambda_nm <= 750; lambda_nm += 35) {
      double const n = glass->index_unchecked(lambda_nm);
      // Minimum deviation: n = sin((D + A)/2) / sin(A/2).
      double const least = 2 * std::asin(n * std::sin(apex / 2)) - apex;
      for (double const off : {0.0, 0.07, -0.05, 0.2}) {
        double const i1 = (least + apex) / 2 + off;
        // Snell, twice: r2 = A - r1.
        double const r1 = std::asin(std::sin(i1) / n);
        double const i2 = std::asin(n * std::sin(apex - r1));
        double const deviation = i1 + i2 - apex;
        // The left face's outward normal is (-cos(A/2), sin(A/2)); a ray going right and upward at
        // the angle i1 to it hits below the apex and is bent toward the base.
        double const slope = i1 - apex / 2;
        Vec3 const direction{std::cos(slope), std::sin(slope), 0};
        Vec3 const hit{-std::sin(apex / 2), -std::cos(apex / 2), 0};
        Vec3 const out = trace_through(world, hit - direction * 3.0, direction, n, 2);
        double const turned = std::atan2(direction.y, direction.x) - std::atan2(out.y, out.x);
        EXPECT_NEAR(turned, deviation, 1e-12) << glass->name() << ' ' << lambda_nm;
        EXPECT_GE(turned, least - 1e-12);
        if (off == 0) {
          EXPECT_NEAR(turned, least, 1e-12);
        }
      }
    }
}

} // namespace
} // namespace abbe::render::testing
