// SPDX-License-Identifier: MIT
#include "geometry/shapes/sphere.hpp"

#include "geometry/shapes/reading.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <numbers>

namespace abbe::geometry {

bool Sphere::inside(Vec3 const& point) const {
  return glm::dot(point, point) <= 1.0;
}
Vec3 Sphere::normal(Vec3 const& point, std::uint32_t) const {
  return glm::normalize(point);
}
/// Round the y axis from +x towards +z, and from pole to pole.
std::optional<Vec2> Sphere::uv(Vec3 const& point, std::uint32_t) const {
  constexpr double pi = std::numbers::pi;
  double const turn = simd::atan2(point.z, point.x) / (2 * pi);
  double const height = point.y / glm::length(point);
  return Vec2(turn < 0 ? turn + 1 : turn, 0.5 + simd::asin(std::clamp(height, -1.0, 1.0)) / pi);
}

Bounds Sphere::bounds() const {
  return {Vec3(-1), Vec3(1)};
}

std::optional<PlacedShape> make_sphere(Vec3 const& centre, double radius) {
  if (!finite(centre) || !usable_size(radius)) return std::nullopt;
  static ShapePtr const unit = std::make_shared<Sphere>();
  return PlacedShape{unit, Placement::scaled_and_moved(Vec3(std::fabs(radius)), centre)};
}

std::optional<PlacedShape> read_sphere(Parameters& parameters) {
  Vec3 const centre = parameters.vec3("centre");
  double const radius = parameters.number("radius");
  if (radius == 0) return left_out(parameters, "E0601", "a sphere of radius 0 is not drawn");
  return or_report(make_sphere(centre, radius), parameters, "E0601",
                   "a sphere needs a finite centre and a finite radius");
}

} // namespace abbe::geometry
