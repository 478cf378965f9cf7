// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene radial
 * The angle around the y axis, 0..1: at +x 1, at +z 3/4, at -x 1/2, at -z 1/4.
 * @code pigment { radial frequency 6 } @endcode */
std::shared_ptr<Pattern const> read_radial(Parameters&);

} // namespace abbe::texture
