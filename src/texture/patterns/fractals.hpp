// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene mandel N | julia C, N | magnet 1|2 mandel N | magnet 1|2 julia C, N
 * Points of the plane of x and y by what becomes of them in N steps of z -> z^2 + c.
 * | item          | default | meaning |
 * | exponent E    | 2       | z^E + c, 2 .. 33; not of magnet |
 * | exterior T, F | 1, 1    | value of what escapes, 0 .. 6 |
 * | interior T, F | 0, 1    | of what does not |
 * T: 0 is F, 1 the share of the steps (interior: F times the smallest |z|), 2 and 3 real and
 * imaginary part of the last z times F, 4 and 5 their squares, 6 F times |z| (interior: re^2 + F
 * im^2).
 * @code pigment { mandel 25 color_map { [0 rgb 0] [.3 rgb <1, .5, .2>] [1 rgb 1] } } @endcode */
std::shared_ptr<Pattern const> read_mandel(Parameters&);
std::shared_ptr<Pattern const> read_julia(Parameters&);
std::shared_ptr<Pattern const> read_magnet(Parameters&);

} // namespace abbe::texture
