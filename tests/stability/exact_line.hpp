// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <vector>

/// What a line has in common with solids whose coordinates are integers, without any rounding:
/// signs of polynomials with integer coefficients decide. Only the numbers that are shown (t and
/// its distance to its neighbours) are doubles, from exact integers, good to a few units in the
/// last place.
namespace abbe::geometry::exact {

using Integer = boost::multiprecision::int512_t;
using Point = std::array<std::int64_t, 3>;

/// origin + t direction, in units of the lattice times 1 / unit.
struct IntegerLine {
  static constexpr std::int64_t unit = std::int64_t{1} << 24;
  Point origin{}, direction{};
};

/// A p.p + ... <= 0 : square[i] x_i^2 + linear . p + constant, integers; no mixed terms.
struct Constraint {
  Point square{}, linear{};
  std::int64_t constant = 0;
};
/// The points that meet all constraints.
struct Body {
  std::vector<Constraint> constraints;
};
Body box(Point const& low, Point const& high);
Body half_space(Point const& normal, std::int64_t level);
Body sphere(Point const& centre, std::int64_t radius);
/// About the axis `axis` through `middle`, from `low` to `high` along it.
Body cylinder(int axis, Point const& middle, std::int64_t low, std::int64_t high,
              std::int64_t radius);
Body cone(int axis, Point const& middle, std::int64_t low, std::int64_t low_radius,
          std::int64_t high, std::int64_t high_radius);

/// A change of the value of the tree.
struct Change {
  double t = 0;
  bool entering = false;
};
struct Answer {
  bool inside_at_start = false;
  std::vector<Change> changes; ///< with t > 0, ascending
  /// Two different crossings, or one and the start, are closer to each other than what rounding the
  /// input to doubles may move them: then the answer for the rounded input may be another one.
  bool doubtful = false;
  int coincident = 0; ///< crossings that are exactly at another body's
};
/// @param rounding how far a coordinate of the scene may be from the integers, in lattice units
Answer follow(IntegerLine const& line, std::vector<Body> const& bodies, CsgTree const& tree,
              double rounding);

} // namespace abbe::geometry::exact
