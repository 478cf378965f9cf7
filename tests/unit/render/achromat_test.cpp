// SPDX-License-Identifier: MIT
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/world.hpp"
#include "optics/refract.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace abbe::render::testing {
namespace {

/// SCHOTT SF2, Sellmeier coefficients of the catalogue.
optics::GlassPtr sf2() {
  return sellmeier("SF2", {1.40301821, 0.231767504, 0.939056586},
                   {0.0105795466, 0.0493226978, 112.405955});
}

/// A cemented doublet on the z axis: surfaces with curvatures c[0..2] at vertices z[0..2].
struct Doublet {
  double c[3];
  double z[3];

  /// Back focal distance by paraxial ray tracing: u' n' = u n - y (n' - n) c.
  double paraxial_bfd(double n_crown, double n_flint) const {
    double const n[4] = {1, n_crown, n_flint, 1};
    double y = 1, nu = 0;
    for (int i = 0; i < 3; ++i) {
      if (i > 0) y += nu / n[i] * (z[i] - z[i - 1]);
      nu -= y * (n[i + 1] - n[i]) * c[i];
    }
    return -y / nu;
  }
};

geometry::CsgTree leaf(geometry::PrimitiveId primitive) {
  geometry::CsgTree out;
  out.primitive = primitive;
  return out;
}

/// Solid 0 the crown (ball, ball), solid 1 the flint between the same ball and its last face: the
/// two share a surface, and nothing is between them.
geometry::World doublet_world(Doublet const& d) {
  using geometry::CsgTree;
  auto const ball = [&](int i) {
    return *geometry::make_sphere({0, 0, d.z[i] + 1 / d.c[i]}, 1 / std::abs(d.c[i]));
  };
  std::vector<geometry::PlacedShape> primitives{
      ball(0), ball(1), ball(1), ball(2),
      *geometry::make_cylinder({0, 0, -4}, {0, 0, 4}, 2, false)};
  CsgTree crown;
  crown.op = CsgTree::Op::Intersection;
  crown.children = {leaf(0), leaf(1), leaf(4)};
  CsgTree flint;
  flint.op = CsgTree::Op::Difference;
  CsgTree between;
  between.op = CsgTree::Op::Intersection;
  primitives.push_back(*geometry::make_plane({0, 0, -1}, 0)); // z >= 0: the side of the flint
  primitives.push_back(*geometry::make_cylinder({0, 0, -4}, {0, 0, 4}, 2, false));
  between.children = {leaf(6), leaf(5), leaf(3)};
  flint.children = {between, leaf(2)};
  return geometry::World(std::move(primitives), {{crown, 0xff}, {flint, 0xff}});
}

/// Where a ray at height y, parallel to the axis, crosses it again, beyond the last vertex.
double traced_bfd(geometry::World const& world, Doublet const& d, double const (&index)[2],
                  double y) {
  auto const scratch = geometry::World::make_scratch();
  geometry::HitGroup hit;
  geometry::Departure from;
  geometry::Ray ray{{0, y, -10}, {0, 0, 1}, Vec3(0)};
  bool inside[2] = {false, false};
  auto const n = [&] { return inside[1] ? index[1] : inside[0] ? index[0] : 1.0; };
  int interfaces = 0;
  while (world.closest(ray, interfaces ? &from : nullptr, 0xff,
                       std::numeric_limits<double>::infinity(), *scratch, hit)) {
    double const n1 = n();
    for (auto const& crossing : hit.crossings) inside[crossing.solid] = crossing.entering;
    double const n2 = n();
    auto const& crossing = hit.crossings.front();
    Vec3 normal = world.normal(crossing.primitive, crossing.face, hit.point);
    if (glm::dot(normal, ray.direction) > 0) normal = -normal;
    Vec3 const cross = glm::cross(ray.direction, normal);
    auto const face = optics::fresnel<double>(n1, n2, n2 - n1, -glm::dot(ray.direction, normal),
                                              glm::dot(cross, cross));
    ray = {hit.point, optics::refracted(face, ray.direction, normal), hit.point_error};
    from.on = hit.members;
    from.through = true;
    ++interfaces;
  }
  EXPECT_EQ(interfaces, 3) << "crown, cement and back: the cemented surface is one interface";
  return ray.origin.z - ray.origin.y * ray.direction.z / ray.direction.y - d.z[2];
}

TEST(Achromat, FocalShiftsAreThoseOfTheParaxialFormula) {
  // f = 100, thin-lens powers that bring F and C together (Abbe numbers 64.17 and 33.85).
  double const f = 100, v1 = 64.17, v2 = 33.85, n1 = 1.5168, n2 = 1.64769;
  double const p1 = v1 / (f * (v1 - v2)), p2 = -v2 / (f * (v1 - v2));
  double const c1 = p1 / (n1 - 1) / 2;
  Doublet const doublet{{c1, -c1, -c1 - p2 / (n2 - 1)}, {-0.6, 0.2, 0.7}};
  ASSERT_LT(doublet.c[2], 0);
  auto const world = doublet_world(doublet);
  auto const crown = n_bk7(), flint = sf2();
  double traced[3], paraxial[3];
  double const lines_nm[3] = {486.1327, 587.5618, 656.2725};
  for (int i = 0; i < 3; ++i) {
    double const index[2] = {crown->index_unchecked(lines_nm[i]),
                             flint->index_unchecked(lines_nm[i])};
    traced[i] = traced_bfd(world, doublet, index, 1e-3);
    paraxial[i] = doublet.paraxial_bfd(index[0], index[1]);
    // Spherical aberration at this height is of the order y^2 / f.
    EXPECT_NEAR(traced[i], paraxial[i], 1e-6);
  }
  // The shifts themselves, F against C and the secondary spectrum of d.
  EXPECT_NEAR(traced[0] - traced[2], paraxial[0] - paraxial[2], 1e-7);
  EXPECT_NEAR(traced[1] - traced[0], paraxial[1] - paraxial[0], 1e-7);
  // And it is an achromat: a singlet of BK7 shifts by f / V = 1.56 between F and C.
  EXPECT_LT(std::abs(traced[0] - traced[2]), 0.05);
}

} // namespace
} // namespace abbe::render::testing
