// SPDX-License-Identifier: MIT
#include "transport/cameras/orthographic.hpp"

#include "transport/cameras/flat.hpp"

namespace abbe::transport {
namespace {

struct SideBySide {
  template <class L>
  static void run(scene::Camera const& camera, PicturePoints const& points,
                  geometry::VectorArrays const& origins, geometry::VectorArrays const& directions) {
    rays_through_plane<L>(
        camera, points, origins, directions,
        []<class Lanes>(lane::Vec<Lanes> const& point, lane::Vec<Lanes> const& direction) {
          return PlaneRay<Lanes>{point, direction};
        });
  }
};
simd::Native<SideBySide> const side_by_side;

} // namespace

void OrthographicCamera::rays(PicturePoints const& points, geometry::VectorArrays const& origins,
                              geometry::VectorArrays const& directions) const {
  side_by_side(camera_, points, origins, directions);
}

Footprint OrthographicCamera::footprint(int width, int height) const {
  return {pixel_size(camera_, width, height), 0};
}

} // namespace abbe::transport
