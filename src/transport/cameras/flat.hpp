// SPDX-License-Identifier: MIT
#pragma once

#include "simd/native.hpp"
#include "transport/cameras/camera.hpp"

namespace abbe::transport {

namespace lane = simd;

/// Rays through a plane: work(k, point, store) for each point from k on, where `point` is on the
/// plane, counted from the middle of the picture, and store(origin, direction) keeps its ray.
/// Points beyond the last whole lane go one by one, so that nothing is written behind the arrays.
template <class L, class Ray>
void rays_through_plane(scene::Camera const& camera, PicturePoints const& points,
                        geometry::VectorArrays const& origins,
                        geometry::VectorArrays const& directions, Ray const& ray) {
  auto const at = [&]<class Lanes>(std::size_t k) {
    auto const every = [](Vec3 const& v) {
      return lane::Vec<Lanes>{Lanes(v.x), Lanes(v.y), Lanes(v.z)};
    };
    auto const keep = [k](geometry::VectorArrays const& to, lane::Vec<Lanes> const& v) {
      lane::store(to.x + k, v.x);
      lane::store(to.y + k, v.y);
      lane::store(to.z + k, v.z);
    };
    Lanes const a = lane::load<Lanes>(points.x + k) / Lanes(points.width) - Lanes(0.5);
    Lanes const b = Lanes(0.5) - lane::load<Lanes>(points.y + k) / Lanes(points.height);
    lane::Vec<Lanes> const point = a * every(camera.right) + b * every(camera.up);
    auto const [origin, direction] = ray(point, every(camera.direction));
    // The unit vector that glm::normalize gives.
    Lanes const scale = Lanes(1.0) / lane::sqrt(lane::dot(direction, direction));
    keep(origins, origin);
    keep(directions, {direction.x * scale, direction.y * scale, direction.z * scale});
  };
  std::size_t k = 0;
  for (; k + lane::width<L> <= points.count; k += lane::width<L>) at.template operator()<L>(k);
  for (; k < points.count; ++k) at.template operator()<double>(k);
}

template <class L>
struct PlaneRay {
  lane::Vec<L> origin, direction;
};

} // namespace abbe::transport
