// SPDX-License-Identifier: MIT
#include "geometry/shapes/registry.hpp"

#include "geometry/shapes/bicubic_patch.hpp"
#include "geometry/shapes/blob.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/isosurface.hpp"
#include "geometry/shapes/julia.hpp"
#include "geometry/shapes/lathe.hpp"
#include "geometry/shapes/mesh_reading.hpp"
#include "geometry/shapes/ovus.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/polygon.hpp"
#include "geometry/shapes/polynomial_surface.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/quadric.hpp"
#include "geometry/shapes/sor.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/sphere_sweep.hpp"
#include "geometry/shapes/superellipsoid.hpp"
#include "geometry/shapes/torus.hpp"

namespace abbe::geometry {

std::span<ShapeKind const> shape_kinds() {
  static constexpr ShapeKind kinds[] = {
      {"bicubic_patch", read_bicubic_patch},
      {"blob", read_blob},
      {"box", read_box},
      {"cone", read_cone},
      {"cubic", read_cubic},
      {"cylinder", read_cylinder},
      {"disc", read_disc},
      {"isosurface", read_isosurface},
      {"julia_fractal", read_julia_fractal},
      {"lathe", read_lathe},
      {"mesh", read_mesh},
      {"mesh2", read_mesh2},
      {"ovus", read_ovus},
      {"plane", read_plane},
      {"poly", read_poly},
      {"polygon", read_polygon},
      {"polynomial", read_polynomial},
      {"prism", read_prism},
      {"quadric", read_quadric},
      {"quartic", read_quartic},
      {"smooth_triangle", read_smooth_triangle},
      {"sor", read_sor},
      {"sphere", read_sphere},
      {"sphere_sweep", read_sphere_sweep},
      {"superellipsoid", read_superellipsoid},
      {"torus", read_torus},
      {"triangle", read_triangle},
  };
  return kinds;
}

} // namespace abbe::geometry
