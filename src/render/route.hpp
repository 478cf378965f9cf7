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
  /// @param light throughput of the ray that is to come
  void start(double light);
  /// Called where a ray begins; the one before it has then met what it meets.
  void begin(Tracer& tracer, int depth, PathRay const& ray, Beam const& beam);
  void end(Tracer const& tracer) { close(tracer, 0); }

  /// How far apart both went, at most, in pixels: of rays with a share of the light, times that
  /// share, for so much a displacement changes what is seen. Infinite where they met different
  /// surfaces. @param sky rays that met nothing count by their directions
  double apart_px(Route const& other, Footprint const& footprint, bool sky) const;

private:
  struct Visit {
    int depth = 0;
    bool met = false;
    double share = 1; ///< of the light that started
    geometry::PrimitiveId primitive{};
    Vec3 direction{0};
    Vec3 point{0};
  };
  /// Takes what the rays at this depth and below met.
  void close(Tracer const& tracer, int depth);

  std::vector<Visit> visits_;
  std::vector<std::size_t> open_;
  double light_ = 0;
};

} // namespace abbe::render
