// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene quilted [control0 C0] [control1 C1]
 * Padded unit cubes.
 * | parameter | type  | default | meaning |
 * | control0  | float | 1       | slope at the middle of a cube |
 * | control1  | float | 1       | slope at its border |
 * @code pigment { quilted control0 .5 control1 .8 scale .5 } @endcode */
std::shared_ptr<Pattern const> read_quilted(Parameters&);

} // namespace abbe::texture
