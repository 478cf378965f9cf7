// SPDX-License-Identifier: MIT
#include "geometry/shapes/registry.hpp"

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/mesh_reading.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/quadric.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"

namespace abbe::geometry {

std::span<ShapeKind const> shape_kinds() {
  static constexpr ShapeKind kinds[] = {
      {"box", read_box},           {"cone", read_cone},
      {"cylinder", read_cylinder}, {"disc", read_disc},
      {"mesh", read_mesh},         {"mesh2", read_mesh2},
      {"plane", read_plane},       {"prism", read_prism},
      {"quadric", read_quadric},   {"smooth_triangle", read_smooth_triangle},
      {"sphere", read_sphere},     {"torus", read_torus},
      {"triangle", read_triangle},
  };
  return kinds;
}

} // namespace abbe::geometry
