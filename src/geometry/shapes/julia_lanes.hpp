// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"

#include <cstdint>

namespace abbe::geometry {

/// A line through the numbers of a julia_fractal whose function is a polynomial.
struct JuliaLine {
  enum class Kind : std::uint8_t {
    Squares,       ///< of quaternions
    Cubes,         ///< of quaternions
    Pairs,         ///< squares of hypercomplex numbers, as pairs of complex ones
    ReturningPairs ///< which may come back from beyond the bailout
  };
  Vec4 origin, direction; ///< lifted to the numbers
  Vec4 added;
  int rounds;
  double limit; ///< square of the bailout
  double grain; ///< rounding of a number's place, as a share of how far its places are from zero
  double origin_size, direction_size; ///< how far: origin_size + |t| direction_size
};

/// JuliaField's enclosures of several pieces side by side.
///
/// The ball about a number of size s with radius r goes to one about its square with radius
/// (2 s + r) r, about its cube with (3 s^2 + 3 s r + r^2) r: these hold for quaternions, whose
/// sizes multiply. The derivative along the line goes with a ball of its own.
void julia_along_each(JuliaLine::Kind kind, JuliaLine const& line, LinePieces& pieces);

} // namespace abbe::geometry
