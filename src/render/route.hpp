// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "render/camera.hpp"

#include <vector>

namespace abbe::render {

class Tracer;
struct PathRay;
struct Beam;

/// Where a monochromatic ray and all that came of it went: two wavelengths whose routes agree can
/// share one.
class Route {
public:
  /// @param least throughput of rays that count
  void start(double least);
  /// Called where a ray begins; the one before it has then met what it meets.
  void begin(Tracer& tracer, int depth, PathRay const& ray, Beam const& beam);
  void end(Tracer const& tracer) { close(tracer, 0); }

  /// Did both meet the same surfaces, never further apart than the tolerance? @param sky rays that
  /// met nothing must have had the same direction, within the tolerance
  bool agrees(Route const& other, Footprint const& footprint, double tolerance_px, bool sky) const;

private:
  struct Visit {
    int depth = 0;
    bool met = false;
    geometry::PrimitiveId primitive{};
    Vec3 direction{0};
    Vec3 point{0};
  };
  /// Takes what the rays at this depth and below met.
  void close(Tracer const& tracer, int depth);

  std::vector<Visit> visits_;
  std::vector<std::size_t> open_;
  double least_ = 0;
};

} // namespace abbe::render
