// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

namespace abbe::geometry {

/** @scene triangle { <a>, <b>, <c> }
A flat triangle, a patch without an inside. One without area is dropped with a warning.

    triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
*/
std::optional<PlacedShape> read_triangle(Parameters& parameters);

/** @scene smooth_triangle { <a>, <normal_a>, <b>, <normal_b>, <c>, <normal_c> }
A triangle whose shading normal changes from corner to corner.

    smooth_triangle { <0, 0, 0>, <-1, 0, -2>, <1, 0, 0>, <1, 0, -2>, <0, 1, 0>, <0, 1, -2> }
*/
std::optional<PlacedShape> read_smooth_triangle(Parameters& parameters);

/** @scene mesh { triangle { ... } | smooth_triangle { ... } ... [inside_vector <v>] }
Many triangles as one object; each may have `uv_vectors <u,v>, <u,v>, <u,v>` and `texture { ... }`
or `texture_list { ... }` with three textures, of the corners. Solid with `inside_vector`.

    mesh { triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } triangle { <0, 0, 0>, <0, 1, 0>, <-1, 0, 0>
} }
*/
std::optional<PlacedShape> read_mesh(Parameters& parameters);

/** @scene mesh2 { vertex_vectors { n, <v> ... } ... face_indices { n, <i, j, k> ... } ... }
Many triangles by numbered corners: vertex_vectors, [normal_vectors], [uv_vectors], [texture_list],
face_indices { n, <i, j, k> [, texture [, texture, texture]] ... }, [uv_indices], [normal_indices],
[inside_vector <v>]. Missing uv or normal indices are the face's own.

    mesh2 { vertex_vectors { 3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0> } face_indices { 1, <0, 1, 2> } }
*/
std::optional<PlacedShape> read_mesh2(Parameters& parameters);

} // namespace abbe::geometry
