// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene wood
 * Rings around the z axis, one a unit, which turbulence (x and y) makes wavy. Default wave:
 * triangle.
 * @code pigment { wood turbulence .1 rotate 90*x scale .2 } @endcode */
std::shared_ptr<Pattern const> read_wood(Parameters&);

} // namespace abbe::texture
