// SPDX-License-Identifier: MIT
#include "geometry/shapes/cone.hpp"

#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/reading.hpp"
#include "simd/math.hpp"

namespace abbe::geometry {

bool Cone::inside(Vec3 const& point) const {
  double const radius = middle_ + rate_ * point.y;
  return std::fabs(point.y) <= 1 && simd::hypot(point.x, point.z) <= radius;
}

Vec3 Cone::normal(Vec3 const& point, std::uint32_t face) const {
  if (face > 0) return {0, face == 1 ? -1 : 1, 0};
  double const radius = simd::hypot(point.x, point.z);
  if (radius == 0) return {0, rate_ > 0 ? -1 : 1, 0}; // the apex
  return glm::normalize(Vec3(point.x / radius, -rate_, point.z / radius));
}

Bounds Cone::bounds() const {
  return {Vec3(-1), Vec3(1)};
}

DoubleCone::DoubleCone(double middle, double rate, bool open)
    : base_(rate < 0 ? middle : -middle, rate < 0 ? rate : -rate, open),
      cap_(rate < 0 ? -middle : middle, rate < 0 ? -rate : rate, open) {}

void DoubleCone::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  bool const at_cap = start != nullptr && start->face >= 2;
  base_.crossings(ray, at_cap ? nullptr : start, out);
  std::size_t const first = out.size();
  Start const own{start != nullptr && start->face == 3 ? 0 : 2u,
                  start != nullptr && start->to_inside};
  cap_.crossings(ray, at_cap ? &own : nullptr, out);
  for (std::size_t i = first; i < out.size(); ++i)
    if (out[i].face == 0) out[i].face = 3;
}

bool DoubleCone::inside(Vec3 const& point) const {
  return base_.inside(point) || cap_.inside(point);
}

Vec3 DoubleCone::normal(Vec3 const& point, std::uint32_t face) const {
  return face < 2 ? base_.normal(point, face) : cap_.normal(point, face == 3 ? 0 : face);
}

std::optional<PlacedShape> make_cone(Vec3 const& base, double base_radius, Vec3 const& cap,
                                     double cap_radius, bool open) {
  bool const opposite = (base_radius < 0 && cap_radius > 0) || (base_radius > 0 && cap_radius < 0);
  double const r0 = std::fabs(base_radius);
  double const r1 = opposite ? -std::fabs(cap_radius) : std::fabs(cap_radius);
  double const radius = std::fmax(r0, std::fabs(r1));
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
  if (opposite) return PlacedShape{std::make_shared<DoubleCone>(middle, rate, open), placement};
  return PlacedShape{std::make_shared<Cone>(middle, rate, open), placement};
}

std::optional<PlacedShape> read_cone(Parameters& parameters) {
  Vec3 const base = parameters.vec3("base point");
  double const base_radius = parameters.number("base radius");
  Vec3 const cap = parameters.vec3("cap point");
  double const cap_radius = parameters.number("cap radius");
  bool const open = parameters.flag("open").value_or(false);
  if (base_radius == 0 && cap_radius == 0 && base != cap)
    return left_out(parameters, "E0605", "a cone with both radii 0 is not drawn");
  if (base_radius <= 0 && cap_radius <= 0 && base_radius != cap_radius)
    parameters.report(Severity::Warning, "E0605",
                      "the radii of this cone count as positive (POV-Ray draws something else)");
  return or_report(make_cone(base, base_radius, cap, cap_radius, open), parameters, "E0605",
                   "a cone needs two finite points that differ and finite radii");
}

} // namespace abbe::geometry
