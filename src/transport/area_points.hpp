// SPDX-License-Identifier: MIT
#pragma once

#include "transport/chunk.hpp"
#include "transport/lamps/lamp.hpp"

#include <vector>

namespace abbe::transport {

/// Points of surfaces that an area light lights, as far as its places are to be seen from there.
struct AreaPoints {
  AreaPoints(LightKind const& kind, Rays::Fields const& fields)
      : rays(kind, fields), ways(kind, fields) {}

  Rays rays; ///< to the middle of the light, with what it adds if nothing is in the way
  struct Point {
    RandomKey key;
    Vec3 geometric{0}; ///< normal on the side of the ray that came
    /// Where ways start that stay on this side of the surface, and that go through it.
    geometry::RayStart start[2];
    MediaStacks::Id stack[2] = {};
    Area::Axes axes;
  };
  std::vector<Point> points; ///< of each ray
  std::vector<double> full;  ///< light of the lamp there, a value a lane

  Rays ways; ///< to places, while these are looked for
  /// What is known of the places of some points, the light of those that are seen, and the sums
  /// over the points' places.
  std::vector<std::uint8_t> known, whole;
  std::vector<double> seen, sums;

  /// Of rays that Shadows adds to `rays`.
  void add(Chunk const& chunk, std::size_t number, Lamp const& lamp, Aim const& aim, RaySet lit);
  void clear() {
    rays.clear();
    points.clear();
    full.clear();
  }
};

} // namespace abbe::transport
