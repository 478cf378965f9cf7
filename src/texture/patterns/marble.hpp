// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene marble
 * Layers across x, which turbulence (its x component) shakes. Default wave: triangle.
 * @code pigment { marble turbulence .8 color_map { [0 rgb 1] [1 rgb <.2, .2, .3>] } } @endcode */
std::shared_ptr<Pattern const> read_marble(Parameters&);

} // namespace abbe::texture
