// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene brick [MORTAR [, BRICK]] [brick_size SIZE] [mortar WIDTH]
 * A list pattern: courses of bricks, the first item between them.
 * | parameter  | type   | default    | range | meaning |
 * | brick_size | vector | <8, 3, 4.5> | > 0  | of a brick with its mortar |
 * | mortar     | float  | .5         | >= 0  | width of the joints |
 * Every second course is shifted by half a brick along x, the others along z.
 * @code pigment { brick rgb .7, rgb <.6, .15, .1> brick_size <1, .4, .5> mortar .05 } @endcode */
std::shared_ptr<Pattern const> read_brick(Parameters&);

} // namespace abbe::texture
