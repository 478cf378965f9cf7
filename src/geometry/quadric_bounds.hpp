// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bounds.hpp"
#include "geometry/placed.hpp"

#include <array>
#include <vector>

namespace abbe::geometry {

/// A quadric by its equation in the directions of the world.
struct WorldQuadric {
  /// Where x, y and z are counted from: coefficients of a body far from the origin keep their
  /// digits.
  Vec3 origin;
  /// Of x^2, y^2, z^2, xy, xz, yz, x, y, z and 1: inside where their sum is at most 0.
  std::array<double, 10> k;

  static WorldQuadric of(Placed const& placed, std::array<double, 10> const& coefficients);
};

/// The box around what half-spaces and quadrics have in common: a cylinder between two planes, a
/// hyperboloid cut off above and below. Half-spaces count that are square to an axis.
/// @return infinite where that is, or where it is not found
Bounds bounds_of(std::vector<HalfSpace> const& spaces, std::vector<WorldQuadric> const& quadrics);

} // namespace abbe::geometry
