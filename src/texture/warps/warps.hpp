// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

/// What each warp reads behind its word.
namespace abbe::texture {

/** @scene warp { repeat V [offset O] [flip F] }
 * Repeats a slice of the pattern along the one axis that V has a width on.
 * @code pigment { gradient x warp { repeat .5*x flip x } } @endcode */
std::shared_ptr<Warp const> read_repeat_warp(Parameters&);

/** @scene warp { black_hole CENTRE, RADIUS [strength S] [falloff F] [inverse] [repeat V] }
 * Draws the pattern in a ball towards its centre; `inverse`: pushes it away.
 * @code pigment { checker scale .1 warp { black_hole 0, 1 falloff 2 strength 1 } } @endcode */
std::shared_ptr<Warp const> read_black_hole_warp(Parameters&);

/** @scene warp { turbulence V [octaves I] [omega W] [lambda L] }
 * Turbulence as a step of the way, where the modifier of the same name comes last.
 * @code pigment { wood warp { turbulence .2 } scale .5 } @endcode */
std::shared_ptr<Warp const> read_turbulence_warp(Parameters&);

/** @scene warp { planar [V, D] } | warp { cubic }
 *       | warp { cylindrical | spherical | toroidal [orientation V] [dist_exp E] [major_radius R] }
 * Unrolls a body so that a flat pattern lies on it.
 * @code pigment { checker scale .1 warp { spherical orientation y } } @endcode */
std::shared_ptr<Warp const> read_planar_warp(Parameters&);
std::shared_ptr<Warp const> read_cubic_warp(Parameters&);
std::shared_ptr<Warp const> read_cylindrical_warp(Parameters&);
std::shared_ptr<Warp const> read_spherical_warp(Parameters&);
std::shared_ptr<Warp const> read_toroidal_warp(Parameters&);

} // namespace abbe::texture
