// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"
#include "geometry/shapes/julia_field.hpp"

namespace abbe::geometry {

/** @scene julia_fractal { <cx, cy, cz, cw> [quaternion | hypercomplex] [FUNCTION] [max_iteration n]
[precision p] [slice <nx, ny, nz, nw>, d] }
The points of a slice of four-dimensional space that do not run away when a function and the
addition of c are carried out on them again and again: of n numbers, the point being the first, none
is larger than 1 + |c| (quaternion) or 4 (hypercomplex). FUNCTION is sqr or cube of quaternions, and
of hypercomplex numbers sqr, exp, reciprocal, sin, asin, sinh, asinh, cos, acos, cosh, acosh, tan,
atan, tanh, atanh, ln or pwr(x, y). The slice is the points h with n . h = d, n being made a unit
normal.

| name | type | unit | default | range |
|---|---|---|---|---|
| n | integer | - | 20 | 1 to 1000 |
| p | number | - | 20 | above 0: what is smaller than a thousandth of 20 / p may go unseen where
there are more than 12 numbers, or a function other than sqr and cube | | nw | number | - | 1 | not
0 |

    julia_fractal { <-.083, 0, -.83, -.025> quaternion sqr max_iteration 8 precision 15 }
*/
/// An isosurface of a JuliaField in the ball of the bailout.
std::optional<PlacedShape> make_julia_fractal(JuliaRule const& rule, double precision);
std::optional<PlacedShape> read_julia_fractal(Parameters& parameters);

} // namespace abbe::geometry
