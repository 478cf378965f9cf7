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
