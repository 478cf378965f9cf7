// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene spiral1 ARMS | spiral2 ARMS
 * Arms that wind around the z axis; `spiral2` crosses them with rings. Default wave: triangle.
 * | parameter | type    | meaning |
 * | ARMS      | integer | number of arms; its sign is the sense of winding |
 * @code pigment { spiral1 5 scale 2 } @endcode */
std::shared_ptr<Pattern const> read_spiral1(Parameters&);
std::shared_ptr<Pattern const> read_spiral2(Parameters&);

} // namespace abbe::texture
