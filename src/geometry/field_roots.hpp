// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"

#include <vector>

/// Where a scalar field passes a level along a line, by interval arithmetic: no crossing that is
/// more than its own rounding is missed (Mitchell 1990).
///
/// A piece of the line is left out when the enclosure of the values there, or the mean value form
/// made with the enclosure of the slope, does not hold the level; it has one root at most when the
/// enclosure of the slope does not hold zero. Else it is divided, until its ends and middle cannot
/// be told from the level, or cannot be told from each other. Fields that look at several pieces
/// at once (ScalarField::along_each) are asked for eight.
namespace abbe::geometry {

/// Pieces of a line that are looked at before its search is cut short: from then on `resolution`
/// (and a share of 2^-14 of the line) ends the dividing of a smooth field too, from four times as
/// many on any piece. A function whose enclosures never become narrower has such lines.
inline constexpr std::size_t field_pieces = 1 << 14;

struct FieldRoot {
  double at = 0;
  double error = 0;
  bool rising = false;
};

struct FieldLine {
  ScalarField const& field;
  Vec3 origin, direction;
  double level = 0;
  /// Where the field is not smooth: changes of side closer than this may go unseen.
  double resolution = 0;
  /// Roots are wanted up to the first that is beyond this by more than its error.
  double enough = 0;

  /// -1 below the level (and undefined: 1).
  int side(double t) const;
};

/// Bound of the error of a root that doubles see at t: within it the field passes the level, or
/// comes too near to it to tell. A bound of rounding, proven by enclosures: of the slope, or (where
/// that may be zero) of the values at both ends.
/// @param most how far to look, at least
double field_root_error(FieldLine const& line, double t, bool rising, double most);

/// Appends the roots in (low, high), ascending.
void field_roots(FieldLine const& line, double low, double high, std::vector<FieldRoot>& roots);

} // namespace abbe::geometry
