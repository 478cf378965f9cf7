// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene ripples | waves
 * Rings around ten random points of the unit sphere, added up; `waves`: of different wave lengths.
 * Frequency and phase act in the rings and then once more, as on every pattern (POV-Ray's way).
 * @code pigment { ripples frequency 3 scale 2 } @endcode */
std::shared_ptr<Pattern const> read_ripples(Parameters&);
std::shared_ptr<Pattern const> read_waves(Parameters&);
/// The same around another number of points.
std::shared_ptr<Pattern const> make_ripples(int sources);
std::shared_ptr<Pattern const> make_waves(int sources);

} // namespace abbe::texture
