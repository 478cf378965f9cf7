// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene wrinkles
 * Ten octaves of noise, as of crumpled paper.
 * @code pigment { wrinkles color_map { [0 rgb .3] [1 rgb 1] } } @endcode */
std::shared_ptr<Pattern const> read_wrinkles(Parameters&);

} // namespace abbe::texture
