// SPDX-License-Identifier: MIT
#include "geometry/shapes/disc.hpp"

#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

void Disc::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  ConvexShape::crossings(ray, start, out);
  for (std::size_t i = first; i < out.size(); ++i) {
    out[i].visible = on_ring(line_of(ray), out[i].t);
  }
}

Bounds Disc::bounds() const {
  Bounds bounds;
  bounds.infinite = true;
  return bounds;
}

std::optional<PlacedShape> make_disc(Vec3 const& centre, Vec3 const& normal, double radius,
                                     double hole) {
  if (!finite(centre) || !finite(normal) || normal == Vec3(0) || !usable_size(radius)
      || !std::isfinite(hole)) {
    return std::nullopt;
  }
  return PlacedShape{
      std::make_shared<Disc>(unit_vector(normal), std::fabs(radius), std::fabs(hole)),
      Transform::translation(centre)};
}

std::optional<PlacedShape> read_disc(Parameters& parameters) {
  Vec3 const centre = parameters.vec3("centre");
  Vec3 const normal = parameters.vec3("normal");
  double const radius = parameters.number("radius");
  double const hole = parameters.optional_number("hole radius").value_or(0);
  if (radius == 0) return left_out(parameters, "E0606", "a disc of radius 0 is not drawn");
  if (normal == Vec3(0))
    return left_out(parameters, "E0606", "a disc whose normal is zero is not drawn");
  if (std::fabs(hole) >= std::fabs(radius))
    parameters.report(
        Severity::Warning, "E0606",
        "the hole leaves nothing of this disc to be seen; its half-space still counts "
        "in boolean operations");
  return or_report(make_disc(centre, normal, radius, hole), parameters, "E0606",
                   "a disc needs a finite centre, normal and radii");
}

} // namespace abbe::geometry
