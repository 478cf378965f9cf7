// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"
#include "render/stage.hpp"

#include <cstdint>

namespace abbe::render {

/// What a ray is inside of: the solids with an interior, the last entered first. Lives in the
/// arena.
struct InsideNode {
  geometry::SolidId solid;
  InsideNode const* below;
};

/// A ray on its way: where, inside of what, how deep.
struct PathRay {
  geometry::Ray line; ///< unit direction
  geometry::Departure const* from = nullptr;
  InsideNode const* inside = nullptr;
  int level = 0;
  std::uint8_t mask = camera_bit;
  double travelled = 0; ///< before the origin, since the last real surface
};

/// Rays of neighbouring wavelengths, or of neighbouring samples, that met the same surfaces so far.
/// One beam has the light of all: `lanes_each` lanes for the first ray, as many for the next: one
/// for a ray of one wavelength, all channels for one that no surface has split. Arrays are in the
/// arena.
struct FanRay {
  geometry::FanLines const* lines = nullptr;
  geometry::Departure const* from = nullptr;
  InsideNode const* inside = nullptr;
  int level = 0;
  std::uint8_t mask = camera_bit;
  int lanes_each = 1;
  PathRay lane(int k) const {
    return {lines->get(static_cast<std::size_t>(k)), from, inside, level, mask, 0};
  }
};

/// Directions beyond a surface that splits rays, a value a lane.
struct SplitWays {
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;
  Vec3 get(int lane) const { return {x[lane], y[lane], z[lane]}; }
  SplitWays from(int lane) const { return {x + lane, y + lane, z + lane}; }
};
/// Where the rays of a split start: those of one ray, or of some of a fan that split next to each
/// other.
struct SplitStart {
  geometry::FanVectors const* points = nullptr;
  geometry::FanVectors const* errors = nullptr;
  std::size_t first = 0; ///< whose lanes come first
  int lanes_each = 1;    ///< as many of the next
  geometry::Departure const* from = nullptr;
  InsideNode const* inside = nullptr;
  int level = 0;
  std::uint8_t mask = camera_bit;
  std::size_t place(int lane) const { return first + static_cast<std::size_t>(lane / lanes_each); }
  /// A ray of the first.
  PathRay towards(Vec3 const& direction) const {
    return {{points->get(first), direction, errors->get(first)}, from, inside, level, mask, 0};
  }
};

} // namespace abbe::render
