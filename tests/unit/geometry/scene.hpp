// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

#include <cmath>
#include <random>
#include <vector>

/// Helpers of the geometry tests.
namespace abbe::geometry::test {

using Op = CsgTree::Op;

inline CsgTree leaf(PrimitiveId id) {
  CsgTree tree;
  tree.primitive = id;
  return tree;
}
inline CsgTree node(Op op, std::vector<CsgTree> children) {
  CsgTree tree;
  tree.op = op;
  tree.children = std::move(children);
  return tree;
}
inline PlacedShape moved(PlacedShape placed, Transform const& by) {
  placed.placement = placed.placement.then(by);
  return placed;
}
inline Ray ray_from(Vec3 const& origin, Vec3 const& direction) {
  return {origin, direction, Vec3(0)};
}

class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  /// Uniform in [low, high); the same on every machine.
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    double const x = number(-half, half), y = number(-half, half), z = number(-half, half);
    return {x, y, z};
  }
  Vec3 direction() {
    for (;;) {
      Vec3 const v = in_cube(1);
      double const length = glm::length(v);
      if (length > 0.1 && length < 1) return v / length;
    }
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

private:
  std::mt19937_64 engine_;
};

/// Departure from a hit.
inline Departure leave(HitGroup const& hit, bool through) {
  return {hit.members, through};
}

} // namespace abbe::geometry::test
