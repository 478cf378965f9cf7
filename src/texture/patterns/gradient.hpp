// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene gradient DIRECTION
 * | parameter | type   | meaning |
 * | DIRECTION | vector | the value grows along it, 0..1 a unit (its length does not matter) |
 * Starts anew at every whole number; behind the origin it counts up to 1 as well.
 * @code pigment { gradient y color_map { [0 rgb <.6, .7, 1>] [1 rgb <.1, .2, .8>] } } @endcode */
std::shared_ptr<Pattern const> read_gradient(Parameters&);

} // namespace abbe::texture
