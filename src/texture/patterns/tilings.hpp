// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene hexagon [ITEM, ITEM, ITEM] | square [4 ITEMs] | triangular [6 ITEMs] | cubic [6 ITEMs]
 * List patterns: tiles of side 1 in the plane of x and z, no two alike side by side; `cubic`: the
 * six directions +x, +y, +z, -x, -y, -z.
 * @code pigment { hexagon rgb 1, rgb <1, .5, .3>, rgb .2 scale .3 } @endcode */
std::shared_ptr<Pattern const> read_hexagon(Parameters&);
std::shared_ptr<Pattern const> read_square(Parameters&);
std::shared_ptr<Pattern const> read_triangular(Parameters&);
std::shared_ptr<Pattern const> read_cubic(Parameters&);

} // namespace abbe::texture
