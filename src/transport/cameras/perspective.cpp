// SPDX-License-Identifier: MIT
#include "transport/cameras/perspective.hpp"

#include "transport/cameras/flat.hpp"

namespace abbe::transport {
namespace {

struct FromOnePoint {
  template <class L>
  static void run(scene::Camera const& camera, PicturePoints const& points,
                  geometry::VectorArrays const& origins, geometry::VectorArrays const& directions) {
    rays_through_plane<L>(
        camera, points, origins, directions,
        []<class Lanes>(lane::Vec<Lanes> const& point, lane::Vec<Lanes> const& direction) {
          Lanes const zero(0.0);
          return PlaneRay<Lanes>{{zero, zero, zero}, direction + point};
        });
  }
};
simd::Native<FromOnePoint> const from_one_point;

} // namespace

void PerspectiveCamera::rays(PicturePoints const& points, geometry::VectorArrays const& origins,
                             geometry::VectorArrays const& directions) const {
  from_one_point(camera_, points, origins, directions);
}

Footprint PerspectiveCamera::footprint(int width, int height) const {
  return {0, pixel_size(camera_, width, height) / glm::length(camera_.direction)};
}

} // namespace abbe::transport
