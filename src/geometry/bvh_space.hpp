// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <cstdint>

namespace abbe::geometry {

/// A box of a hierarchy: in floats, in a BvhSpace. Wider than what it stands for, never narrower.
struct BvhBox {
  /// The low corner and the negated high one: what grows a box is six times the same minimum.
  float side[6];
  std::uint32_t item;
  /// Twice the centre.
  float middle(int axis) const { return side[axis] - side[axis + 3]; }
};

/// Where the floats of a hierarchy count from, and in what unit: (p - centre) / unit, the largest
/// of which is about 1. A float has 24 bits: a box is kept to 2^-23 of its distance from the
/// centre, which is why that is near the small ones, wherever in the world they are. The unit is a
/// power of two: scaled scenes have the same floats.
struct BvhSpace {
  Vec3 centre{0};
  double unit = 1, per_unit = 1; ///< in [2^-1000, 2^1000]; 1 / unit

  /// The box in floats. It is wider on each side by at least 2^-24 of its distance from the centre,
  /// and 2^-121: more than the roundings of the difference (2^-53) and of the float (2^-24 of a
  /// number that is 2^-23 smaller already), so that it contains the one in doubles.
  BvhBox box(Vec3 const& low, Vec3 const& high, std::uint32_t item) const;
};

/// Looks at all boxes once to find their space.
class BvhSpaceFinder {
public:
  /// Finite, not empty.
  void add(Vec3 const& low, Vec3 const& high);
  BvhSpace space() const;
  /// Around all of them; empty when there are none.
  Bounds const& hull() const { return hull_; }

private:
  Bounds hull_;
  /// Of the centres, each counting by 1 / size: the middle of the small ones.
  Vec3 sum_{0};
  double weight_ = 0;
};

} // namespace abbe::geometry
