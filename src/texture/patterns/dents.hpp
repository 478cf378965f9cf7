// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene dents
 * Noise to the third power: rare bright spots.
 * @code pigment { dents scale .3 } @endcode */
std::shared_ptr<Pattern const> read_dents(Parameters&);

} // namespace abbe::texture
