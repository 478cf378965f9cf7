// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/** @scene crackle [form F] [metric M] [offset O] [solid [BOOL]]
 * Voronoi cells: every unit cube holds one random point; the value is made of the distances to the
 * nearest three.
 * | parameter | type    | default     | range | meaning |
 * | form      | vector  | <-1, 1, 0>  |       | weights of the distances; the sum is clamped to
 * 0..1 | | metric    | float   | 2           | > 0   | exponent m of the distance (sum |d|^m)^(1/m)
 * | | offset    | float   | 0           | >= 0  | a fourth coordinate's difference, added in the
 * root | | solid     | boolean | off         |       | one noise value a cell instead |
 * @code pigment { crackle form <1, 0, 0> metric 1 scale .4 } @endcode */
std::shared_ptr<Pattern const> read_crackle(Parameters&);

/** @scene normal { facets ITEMS }
 * Plane faces with edges between them, of the cells that crackle has. Those of directions cover a
 * ball and leave a plane alone.
 * | item     | default | meaning |
 * | coords A | 0       | how far faces of cells in space lean; 0: faces of cells of directions |
 * | size S   | .1      | of the cells |
 * | metric M | 2       | as of crackle |
 */
std::shared_ptr<Pattern const> read_facets(Parameters&);

} // namespace abbe::texture
