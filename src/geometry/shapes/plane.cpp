// SPDX-License-Identifier: MIT
#include "geometry/shapes/plane.hpp"

#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

Bounds Plane::bounds() const {
  Bounds bounds;
  bounds.infinite = true;
  return bounds;
}

std::optional<PlacedShape> make_plane(Vec3 const& normal, double distance) {
  if (!finite(normal) || normal == Vec3(0) || !std::isfinite(distance)) return std::nullopt;
  Vec3 const unit = unit_vector(normal);
  return PlacedShape{std::make_shared<Plane>(unit),
                     Transform::rounded_translation(unit * distance, 8)};
}

std::optional<PlacedShape> read_plane(Parameters& parameters) {
  Vec3 const normal = parameters.vec3("normal");
  double const distance = parameters.number("distance");
  return or_report(make_plane(normal, distance), parameters, "E0603",
                   "a plane needs a normal that is not zero and a finite distance");
}

} // namespace abbe::geometry
