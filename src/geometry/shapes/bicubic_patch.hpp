// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <array>

namespace abbe::geometry {

/** @scene bicubic_patch { type t [flatness f] [u_steps i] [v_steps j] [uv_vectors <u, v> x 4] <x,
y, z> x 16 } A Bezier surface of degree three in both directions, over a net of four rows of four
points. It is drawn as POV-Ray draws it: halved i times along the rows' number and j times along the
rows, or until a piece's points are within f of a plane through three of its corners; each piece is
two triangles with the surface's own normals at the corners, and no inside. Both types give the same
picture.

| name | type | unit | default | range |
|---|---|---|---|---|
| t | integer | - | - | 0, 1 |
| f | number | length | 0 | any |
| i, j | integers | - | 0 | 0 to 10 |

    bicubic_patch { type 1 u_steps 3 v_steps 3
      <0, 0, 0>, <1, 0, 0>, <2, 0, 0>, <3, 0, 0>, <0, 0, 1>, <1, 2, 1>, <2, 2, 1>, <3, 0, 1>,
      <0, 0, 2>, <1, 2, 2>, <2, 2, 2>, <3, 0, 2>, <0, 0, 3>, <1, 0, 3>, <2, 0, 3>, <3, 0, 3> }
*/
struct BicubicPatch {
  using Net = std::array<std::array<Vec3, 4>, 4>;
  Net points;
  int u_steps = 0, v_steps = 0; ///< halvings of the rows' number, and along the rows
  double flatness = 0;
  /// These belong to the corners [0][0], [0][3], [3][3], [3][0].
  std::array<Vec2, 4> uv{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
};

/// A mesh of triangles. @return nullopt: numbers out of range, or no area
std::optional<PlacedShape> make_bicubic_patch(BicubicPatch const& patch);
std::optional<PlacedShape> read_bicubic_patch(Parameters& parameters);

} // namespace abbe::geometry
