// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene bozo | spotted | bumps
 * Smooth random spots: noise itself. They differ in their default map (bozo's is white, green, blue
 * and red in steps), and in normals: bumps adds the vector noise, the others tilt by their slope.
 * @code pigment { bozo color_map { [.4 rgb 1] [.6 rgb <.2, .4, 1>] } turbulence .5 } @endcode */
std::shared_ptr<Pattern const> read_bozo(Parameters&);
std::shared_ptr<Pattern const> read_spotted(Parameters&);
std::shared_ptr<Pattern const> read_bumps(Parameters&);

} // namespace abbe::texture
