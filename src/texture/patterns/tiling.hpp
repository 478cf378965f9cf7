// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene tiling NUMBER
 * Tiles of one to six types t in the plane of x and z, mostly with edges of length 1: 1 to 24. The
 * value is t of n types in the middle, (t + 1) / n on the edge, and between them within the least
 * inner radius of a tile from the edge.
 * @code pigment { tiling 5 color_map { [0 rgb x] [0.3 rgb 0] [0.34 rgb y] [0.6 rgb 0] [0.67 rgb z]
 * [1 rgb 0] } scale .3 } @endcode */
std::shared_ptr<Pattern const> read_tiling(Parameters&);

} // namespace abbe::texture
