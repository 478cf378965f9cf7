// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene average
 * All entries of the map at once; their values are weights.
 * @code pigment { average pigment_map { [1 gradient x] [2 gradient y] } } @endcode */
std::shared_ptr<Pattern const> read_average(Parameters&);

} // namespace abbe::texture
