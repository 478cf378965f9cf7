// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene granite
 * Six octaves of folded noise: fine grains and cracks.
 * @code pigment { granite color_map { [0 rgb 0] [.7 rgb 1] } scale 2 } @endcode */
std::shared_ptr<Pattern const> read_granite(Parameters&);

} // namespace abbe::texture
