// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene slope V | slope { [point_at] V [, LOW, HIGH] [altitude V [, LOW, HIGH]] }
 * How far the surface leans towards a direction or a point: 0 away from it, 1/2 across, 1 towards
 * it; LOW .. HIGH of that is stretched over 0 .. 1. `altitude` mixes in how far along another
 * direction the point is, by the lengths of the two. Only on surfaces: 0 elsewhere.
 * @code pigment { slope { y, .5, 1 } color_map { [0 rgb <.4, .3, .2>] [1 rgb 1] } } @endcode */
std::shared_ptr<Pattern const> read_slope(Parameters&);

/** @scene aoi
 * The angle between ray and normal: 1 where the ray comes straight, 1/2 where it grazes.
 * @code pigment { aoi color_map { [.5 rgb 0] [1 rgb 1] } } @endcode */
std::shared_ptr<Pattern const> read_aoi(Parameters&);

} // namespace abbe::texture
