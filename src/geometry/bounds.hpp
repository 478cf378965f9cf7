// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

/// Boxes of parts put together.
namespace abbe::geometry {

inline Bounds all_space() {
  Bounds bounds;
  bounds.infinite = true;
  return bounds;
}
/// A box of these corners; all space where one of them is beyond what numbers reach.
inline Bounds box_of(Vec3 const& low, Vec3 const& high) {
  // Zero times infinity and zero times not-a-number are not-a-number.
  double const zero = glm::dot(low * 0.0, Vec3(1)) + glm::dot(high * 0.0, Vec3(1));
  return zero == 0 ? Bounds{low, high, false} : all_space();
}
/// What both have in common; may be empty.
inline Bounds overlap(Bounds const& a, Bounds const& b) {
  if (a.infinite) return b;
  if (b.infinite) return a;
  return {glm::max(a.low, b.low), glm::min(a.high, b.high), false};
}
/// The least box around both.
inline Bounds hull(Bounds const& a, Bounds const& b) {
  if (a.infinite || b.infinite) return all_space();
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {glm::min(a.low, b.low), glm::max(a.high, b.high), false};
}

} // namespace abbe::geometry
