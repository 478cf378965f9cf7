// SPDX-License-Identifier: MIT
#include "geometry/shapes/cone.hpp"

#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

bool Cone::inside(Vec3 const& point) const {
  double const radius = middle_ + rate_ * point.y;
  return std::fabs(point.y) <= 1 && std::hypot(point.x, point.z) <= radius;
}

Vec3 Cone::normal(Vec3 const& point, std::uint32_t face) const {
  if (face > 0) return {0, face == 1 ? -1 : 1, 0};
  double const radius = std::hypot(point.x, point.z);
  if (radius == 0) return {0, rate_ > 0 ? -1 : 1, 0}; // the apex
  return glm::normalize(Vec3(point.x / radius, -rate_, point.z / radius));
}

Bounds Cone::bounds() const {
  return {Vec3(-1), Vec3(1)};
}

std::optional<PlacedShape> make_cone(Vec3 const& base, double base_radius, Vec3 const& cap,
                                     double cap_radius, bool open) {
  double const r0 = std::fabs(base_radius), r1 = std::fabs(cap_radius);
  double const radius = std::fmax(r0, r1);
  if (!finite(base) || !finite(cap) || !std::isfinite(r0) || !std::isfinite(r1)
      || !usable_size(radius)) {
    return std::nullopt;
  }
  if (r0 == r1) return make_cylinder(base, cap, r0, open);
  Vec3 const half = cap * 0.5 - base * 0.5;
  double const half_length = vector_length(half);
  if (!usable_size(half_length)) return std::nullopt;
  double const middle = (r0 / radius + r1 / radius) * 0.5;
  double const rate = (r1 - r0) / radius * 0.5;
  Transform const placement = Transform::scaling({radius, half_length, radius})
                                  .then(y_to(half))
                                  .then(Transform::rounded_translation(cap * 0.5 + base * 0.5, 1));
  return PlacedShape{std::make_shared<Cone>(middle, rate, open), placement};
}

std::optional<PlacedShape> read_cone(Parameters& parameters) {
  Vec3 const base = parameters.vec3("base point");
  double const base_radius = parameters.number("base radius");
  Vec3 const cap = parameters.vec3("cap point");
  double const cap_radius = parameters.number("cap radius");
  bool const open = parameters.flag("open").value_or(false);
  return or_report(make_cone(base, base_radius, cap, cap_radius, open), parameters, "E0605",
                   "a cone needs two finite points that differ and radii that are not both zero");
}

} // namespace abbe::geometry
