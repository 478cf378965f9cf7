// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene agate [agate_turb AMOUNT]
 * Bands across z, shaken by its own turbulence (octaves, omega and lambda as written).
 * | parameter  | type  | default | meaning |
 * | agate_turb | float | 1       | amount of its own turbulence |
 * @code pigment { agate agate_turb .6 scale .5 } @endcode */
std::shared_ptr<Pattern const> read_agate(Parameters&);

} // namespace abbe::texture
