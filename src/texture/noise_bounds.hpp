// SPDX-License-Identifier: MIT
#pragma once

#include "base/interval.hpp"
#include "base/vec.hpp"

namespace abbe::texture {

/// Enclosures of noise() and of its gradient in a box.
struct NoiseBounds {
  double at = 0; ///< in the middle, but for its rounding
  Interval value;
  Interval gradient[3];
};

/// The gradient is that in the middle, give or take what the second derivatives make of it: within
/// a cell of the lattice they are bounded by how its corners differ, elsewhere by how any could.
/// Both shrink with the box.
/// @param reach half of the box's edges, from its middle
NoiseBounds noise_about(Vec3 const& middle, Vec3 const& reach, int generator);

} // namespace abbe::texture
