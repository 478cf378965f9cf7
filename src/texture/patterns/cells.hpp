// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene cells
 * A random value for every unit cube.
 * @code pigment { cells scale .25 } @endcode */
std::shared_ptr<Pattern const> read_cells(Parameters&);

} // namespace abbe::texture
