// SPDX-License-Identifier: MIT
#include "geometry/shapes/registry.hpp"

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"

namespace abbe::geometry {

std::span<ShapeKind const> shape_kinds() {
  static constexpr ShapeKind kinds[] = {
      {"box", read_box},
      {"cylinder", read_cylinder},
      {"plane", read_plane},
      {"sphere", read_sphere},
  };
  return kinds;
}

} // namespace abbe::geometry
