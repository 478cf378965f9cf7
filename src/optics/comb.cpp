// SPDX-License-Identifier: MIT
#include "optics/comb.hpp"

#include <cmath>

namespace abbe::optics {

double jitter_offset(Comb const& comb, double u) {
  double const half = 0.5 * comb.width;
  if (comb.jitter != Comb::Jitter::Triangular) return half * (2 * u - 1);
  // Inverse of the cumulative of 1 - |x| on [-1, 1].
  double const t = u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u));
  return half * t;
}

} // namespace abbe::optics
