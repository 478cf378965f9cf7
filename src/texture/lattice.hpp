// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

/// Integer cells of space, for coordinates of any size (NaN and infinities fall into cell 0).
namespace abbe::texture {

/// POV-Ray's tolerance in choosing a cell: part of the definition of its patterns (a plane at an
/// integer coordinate belongs to the upper cell), not a guard against rounding.
inline constexpr double cell_tolerance = 1e-10;

/// Below this size a coordinate is converted to int directly.
inline constexpr double direct_cell_limit = 0x1p30;

/// An integral double modulo 2^k, as two's complement `&` would give; mask = 2^k - 1.
inline int wrapped_far(double cell, int mask) {
  if (!std::isfinite(cell)) return 0;
  double const size = mask + 1.0;
  return static_cast<int>(cell - size * std::floor(cell / size));
}

/// floor(c) & mask.
inline int wrapped_floor(double c, int mask) {
  if (!(std::abs(c) < direct_cell_limit)) return wrapped_far(std::floor(c), mask);
  int const truncated = static_cast<int>(c);
  return (truncated - (c < truncated ? 1 : 0)) & mask;
}

/// The cell that POV-Ray's noise puts a coordinate into: floor, except that what lies less than
/// cell_tolerance below a negative integer is put into the cell that begins there (fraction < 0).
struct NoiseCell {
  int index;       ///< (cell + 10000) & 4095
  double fraction; ///< c - cell
};

inline NoiseCell noise_cell(double c) {
  if (!(std::abs(c) < direct_cell_limit)) {
    if (!std::isfinite(c)) return {0, 0};
    double const cell = std::floor(c);
    return {wrapped_far(cell + 10000, 4095), c - cell};
  }
  int const cell = static_cast<int>(c >= 0 ? c : c - (1 - cell_tolerance));
  return {(cell + 10000) & 4095, c - cell};
}

} // namespace abbe::texture
