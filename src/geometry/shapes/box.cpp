// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"

#include "geometry/shapes/polygon.hpp"
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

/// The net of a box: four faces side by side, one above and one below.
std::optional<Vec2> Box::uv(Vec3 const& point, std::uint32_t face) const {
  constexpr double third = 1.0 / 3;
  Vec3 const q = (point + 1.0) / 2.0;
  switch (face) {
  case 0:
    return Vec2(q.z / 4, third + q.y / 3);
  case 1:
    return Vec2(0.75 - q.z / 4, third + q.y / 3);
  case 2:
    return Vec2(0.25 + q.x / 4, q.z / 3);
  case 3:
    return Vec2(0.25 + q.x / 4, 1 - q.z / 3);
  case 4:
    return Vec2(1 - q.x / 4, third + q.y / 3);
  default:
    return Vec2(0.25 + q.x / 4, third + q.y / 3);
  }
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

namespace {

/// Between corners that agree in the coordinate `flat` alone.
std::optional<PlacedShape> make_rectangle(Vec3 const& corner, Vec3 const& opposite, int flat) {
  Vec3 second = corner, fourth = corner;
  second[(flat + 1) % 3] = opposite[(flat + 1) % 3];
  fourth[(flat + 2) % 3] = opposite[(flat + 2) % 3];
  return make_polygon({{corner, second, opposite, fourth}}, Vec3(0), true);
}

} // namespace

std::optional<PlacedShape> read_box(Parameters& parameters) {
  Vec3 const corner = parameters.vec3("corner");
  Vec3 const opposite = parameters.vec3("opposite corner");
  int const flat = (corner.x == opposite.x) + (corner.y == opposite.y) + (corner.z == opposite.z);
  if (flat > 1)
    return left_out(parameters, "E0602",
                    "a box whose corners differ in less than two of x, y and z is not drawn");
  if (flat == 1) {
    parameters.report(Severity::Warning, "E0602",
                      "this box is flat: it is drawn as a rectangle and has no inside");
    int const axis = corner.x == opposite.x ? 0 : (corner.y == opposite.y ? 1 : 2);
    return or_report(make_rectangle(corner, opposite, axis), parameters, "E0602",
                     "a box needs two finite corners");
  }
  return or_report(make_box(corner, opposite), parameters, "E0602",
                   "a box needs two finite corners, not too near to each other for numbers");
}

} // namespace abbe::geometry
