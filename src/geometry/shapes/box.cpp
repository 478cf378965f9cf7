// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"

#include "geometry/shapes/reading.hpp"

namespace abbe::geometry {

bool Box::inside(Vec3 const& point) const {
  Vec3 const size = glm::abs(point);
  return size.x <= 1 && size.y <= 1 && size.z <= 1;
}

Vec3 Box::normal(Vec3 const&, std::uint32_t face) const {
  Vec3 result(0);
  result[static_cast<int>(face / 2)] = face % 2 == 0 ? -1 : 1;
  return result;
}

Bounds Box::bounds() const {
  return {Vec3(-1), Vec3(1)};
}

std::optional<PlacedShape> make_box(Vec3 const& corner, Vec3 const& opposite) {
  if (!finite(corner) || !finite(opposite)) return std::nullopt;
  static ShapePtr const cube = std::make_shared<Box>();
  Vec3 const half = glm::abs(opposite * 0.5 - corner * 0.5);
  if (!usable_size(half.x) || !usable_size(half.y) || !usable_size(half.z)) return std::nullopt;
  Vec3 const middle = corner * 0.5 + opposite * 0.5;
  return PlacedShape{cube,
                     Transform::scaling(half).then(Transform::rounded_translation(middle, 1))};
}

std::optional<PlacedShape> read_box(Parameters& parameters) {
  Vec3 const corner = parameters.vec3("corner");
  Vec3 const opposite = parameters.vec3("opposite corner");
  return or_report(make_box(corner, opposite), parameters, "E0602",
                   "a box needs two finite corners that differ in x, y and z");
}

} // namespace abbe::geometry
