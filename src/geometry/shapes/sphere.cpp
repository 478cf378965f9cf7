// SPDX-License-Identifier: MIT
#include "geometry/shapes/sphere.hpp"

#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

bool Sphere::inside(Vec3 const& point) const {
  return glm::dot(point, point) <= 1.0;
}
Vec3 Sphere::normal(Vec3 const& point, std::uint32_t) const {
  return glm::normalize(point);
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
