// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene spherical | cylindrical | planar | boxed | onion
 * Distance from a centre: 1 at the origin (of the y axis, of the plane y = 0, of a cube) falling to
 * 0 at distance 1 and beyond. `onion`: the distance from the origin, starting anew at every whole
 * one.
 * @code pigment { spherical color_map { [0 rgb 0] [1 rgb <1, .8, .2>] } scale 2 } @endcode */
std::shared_ptr<Pattern const> read_spherical(Parameters&);
std::shared_ptr<Pattern const> read_cylindrical(Parameters&);
std::shared_ptr<Pattern const> read_planar(Parameters&);
std::shared_ptr<Pattern const> read_boxed(Parameters&);
std::shared_ptr<Pattern const> read_onion(Parameters&);

} // namespace abbe::texture
