// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/batch.hpp"

#include <algorithm>
#include <cstddef>

/// Fans: rays of neighbouring wavelengths, which left the same surface for nearly the same
/// direction. The hierarchy is walked once for all of them, and convex shapes are asked for four
/// lines at a time; each answer has the bits of World::closest for that ray alone.
namespace abbe::geometry {

/// Rays of one fan, at most.
inline constexpr std::size_t fan_width = 32;

/// A vector a ray, component by component.
struct FanVectors {
  alignas(32) double x[fan_width], y[fan_width], z[fan_width];
  Vec3 get(std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, Vec3 const& v) {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
  /// Those at some places of a batch, ascending.
  void take(VectorArrays const& from, std::uint32_t const* place, std::size_t count) {
    std::uint32_t const first = place[0];
    if (place[count - 1] - first + 1 == count) {
      std::copy_n(from.x + first, count, x);
      std::copy_n(from.y + first, count, y);
      std::copy_n(from.z + first, count, z);
      return;
    }
    for (std::size_t k = 0; k < count; ++k) set(k, from.get(place[k]));
  }
};

/// The rays. Places beyond `count` are kept finite by fill(): kernels compute whole lanes.
struct FanLines {
  std::size_t count = 0;
  FanVectors origin, direction, origin_error; ///< as in Ray
  Ray get(std::size_t k) const {
    return {origin.get(k), direction.get(k), origin_error.get(k), Vec3(0), Vec3(0)};
  }
  void copy(std::size_t to, FanLines const& from, std::size_t k);
  /// Repeats the last ray up to a whole number of lanes.
  void fill();
};

} // namespace abbe::geometry
