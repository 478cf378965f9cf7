// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

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
  /// Of the first `count` rays; whole lanes of four.
  void take(FanVectors const& from, std::size_t count) {
    std::size_t const whole = (count + 3) / 4 * 4;
    std::copy_n(from.x, whole, x);
    std::copy_n(from.y, whole, y);
    std::copy_n(from.z, whole, z);
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

/// What one ray of a fan meets first.
struct FanHit {
  enum class Kind : std::uint8_t {
    Nothing,
    Single, ///< one crossing, of one primitive, clear of all others
    Pair,   ///< two, of two solids, within their errors: World::closest_pair
    Unclear ///< a group of several: ask World::closest
  };
  Kind kind = Kind::Nothing;
  bool entering = false, toggles = true; ///< as in SurfaceCrossing
  bool was_entering = false;             ///< the primitive (the solid may be its inverse)
  SolidId solid = 0;
  PrimitiveId primitive = 0;
  std::uint32_t face = 0;
  bool operator==(FanHit const&) const = default;
};

/// The nearest crossing, and the one that is in a group with it.
struct FanPair {
  SurfaceCrossing crossing[2];
  double error[2];
  bool was_entering[2];
};

/// What the rays of a fan meet first.
struct FanHits {
  FanHit hit[fan_width];
  FanPair pair[fan_width];                           ///< of Pairs
  alignas(32) double t[fan_width], error[fan_width]; ///< of Single ones
  FanVectors point, point_error;                     ///< as in HitGroup
  void copy(std::size_t to, FanHits const& from, std::size_t k);
  /// Writes a Single as World::closest does.
  void write(std::size_t k, HitGroup& out) const;
  /// The same into a group that already has another Single of the same surface.
  void write_place(std::size_t k, HitGroup& out) const {
    out.t = out.crossings[0].t = t[k];
    out.error = error[k];
    out.point = point.get(k);
    out.point_error = point_error.get(k);
  }
};

} // namespace abbe::geometry
