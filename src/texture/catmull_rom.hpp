// SPDX-License-Identifier: MIT
#pragma once

namespace abbe::texture {

/// Shares of four values in a row, of the curve of Catmull and Rom through the two in the middle.
/// @param t between these, 0..1
inline void catmull_rom(double t, double* shares) {
  shares[0] = 0.5 * (-t + 2 * t * t - t * t * t);
  shares[1] = 0.5 * (2 - 5 * t * t + 3 * t * t * t);
  shares[2] = 0.5 * (t + 4 * t * t - 3 * t * t * t);
  shares[3] = 0.5 * (-t * t + t * t * t);
}

} // namespace abbe::texture
