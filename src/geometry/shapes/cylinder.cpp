// SPDX-License-Identifier: MIT
#include "geometry/shapes/cylinder.hpp"

#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

bool Cylinder::inside(Vec3 const& point) const {
  return std::fabs(point.y) <= 1 && point.x * point.x + point.z * point.z <= 1;
}

Vec3 Cylinder::normal(Vec3 const& point, std::uint32_t face) const {
  if (face > 0) return {0, face == 1 ? -1 : 1, 0};
  return glm::normalize(Vec3(point.x, 0, point.z));
}

Bounds Cylinder::bounds() const {
  return {Vec3(-1), Vec3(1)};
}

std::optional<PlacedShape> make_cylinder(Vec3 const& base, Vec3 const& cap, double radius,
                                         bool open) {
  if (!finite(base) || !finite(cap) || !usable_size(radius)) return std::nullopt;
  Vec3 const half = cap * 0.5 - base * 0.5;
  double const half_length = vector_length(half);
  if (!usable_size(half_length)) return std::nullopt;
  double const r = std::fabs(radius);
  Transform const placement = Transform::scaling({r, half_length, r})
                                  .then(y_to(half))
                                  .then(Transform::rounded_translation(cap * 0.5 + base * 0.5, 1));
  return PlacedShape{std::make_shared<Cylinder>(open), placement};
}

std::optional<PlacedShape> read_cylinder(Parameters& parameters) {
  Vec3 const base = parameters.vec3("base point");
  Vec3 const cap = parameters.vec3("cap point");
  double const radius = parameters.number("radius");
  bool const open = parameters.flag("open").value_or(false);
  if (radius == 0 && base != cap)
    return left_out(parameters, "E0604", "a cylinder of radius 0 is not drawn");
  return or_report(make_cylinder(base, cap, radius, open), parameters, "E0604",
                   "a cylinder needs two finite points that differ and a finite radius");
}

} // namespace abbe::geometry
