// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene leopard
 * Round spots in space: ((sin x + sin y + sin z) / 3)^2.
 * @code pigment { leopard color_map { [0 rgb <1, .7, .3>] [1 rgb 0] } scale .1 } @endcode */
std::shared_ptr<Pattern const> read_leopard(Parameters&);

} // namespace abbe::texture
