// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

#include "simd/native.hpp"

#include <algorithm>

namespace abbe::render {

namespace {

/// Where points of the picture are.
struct PicturePoints {
  scene::Camera const& camera;
  double const *x, *y;
  double width, height;
};

template <class L>
lane::Vec<L> all(Vec3 const& v) {
  return {L(v.x), L(v.y), L(v.z)};
}

/// The unit vector that glm::normalize gives.
template <class L>
lane::Vec<L> unit(lane::Vec<L> const& v) {
  L const scale = L(1.0) / lane::sqrt(lane::dot(v, v));
  return {v.x * scale, v.y * scale, v.z * scale};
}

/// Origins and directions from point k on.
template <class L>
void rays_at(PicturePoints const& points, std::size_t k, lane::Vec<L>& origin,
             lane::Vec<L>& direction) {
  scene::Camera const& camera = points.camera;
  L const a = lane::load<L>(points.x + k) / L(points.width) - L(0.5);
  L const b = L(0.5) - lane::load<L>(points.y + k) / L(points.height);
  lane::Vec<L> const across = a * all<L>(camera.right) + b * all<L>(camera.up);
  if (camera.kind == scene::Camera::Kind::Orthographic) {
    origin = across;
    direction = unit(all<L>(camera.direction));
  } else {
    origin = all<L>(Vec3(0));
    direction = unit(all<L>(camera.direction) + across);
  }
}

template <class L>
void store(geometry::FanVectors& to, std::size_t at, lane::Vec<L> const& v) {
  lane::store(to.x + at, v.x);
  lane::store(to.y + at, v.y);
  lane::store(to.z + at, v.z);
}

struct FanOf {
  template <class L>
  static void run(PicturePoints const& points, geometry::FanLines& rays) {
    lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t k) {
      lane::Vec<Lanes> origin, direction;
      rays_at(points, k, origin, direction);
      store(rays.origin, k, origin);
      store(rays.direction, k, direction);
      store(rays.origin_error, k, all<Lanes>(Vec3(0)));
    });
  }
};

simd::Native<FanOf> const fan_of;

} // namespace

geometry::Ray camera_ray(scene::Camera const& camera, double x, double y, int width, int height) {
  lane::Vec<double> origin, direction;
  rays_at({camera, &x, &y, static_cast<double>(width), static_cast<double>(height)}, 0, origin,
          direction);
  geometry::Ray ray;
  ray.origin = {origin.x, origin.y, origin.z};
  ray.direction = {direction.x, direction.y, direction.z};
  return ray;
}

void camera_rays(scene::Camera const& camera, double const* x, double const* y, int width,
                 int height, geometry::FanLines& rays) {
  fan_of({camera, x, y, static_cast<double>(width), static_cast<double>(height)}, rays);
}

Footprint pixel_footprint(scene::Camera const& camera, int width, int height) {
  double const across = glm::length(camera.right) / width, down = glm::length(camera.up) / height;
  // A camera that sees along one plane may have no height.
  double const size = across > 0 && down > 0 ? std::min(across, down) : std::max(across, down);
  if (camera.kind == scene::Camera::Kind::Orthographic) return {size, 0};
  return {0, size / glm::length(camera.direction)};
}

} // namespace abbe::render
