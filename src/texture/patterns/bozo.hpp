// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene bozo | spotted | bumps
 * Smooth random spots: noise itself. The three differ in their default map only: bozo's is white,
 * green, blue and red in steps.
 * @code pigment { bozo color_map { [.4 rgb 1] [.6 rgb <.2, .4, 1>] } turbulence .5 } @endcode */
std::shared_ptr<Pattern const> read_bozo(Parameters&);
std::shared_ptr<Pattern const> read_spotted(Parameters&); ///< also bumps

} // namespace abbe::texture
