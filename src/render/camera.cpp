// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

#include <algorithm>

namespace abbe::render {

geometry::Ray camera_ray(scene::Camera const& camera, double x, double y, int width, int height) {
  double const a = x / width - 0.5;
  double const b = 0.5 - y / height;
  Vec3 const across = a * camera.right + b * camera.up;
  geometry::Ray ray;
  if (camera.kind == scene::Camera::Kind::Orthographic) {
    ray.origin = across;
    ray.direction = glm::normalize(camera.direction);
  } else {
    ray.direction = glm::normalize(camera.direction + across);
  }
  return ray;
}

Footprint pixel_footprint(scene::Camera const& camera, int width, int height) {
  double const size = std::min(glm::length(camera.right) / width, glm::length(camera.up) / height);
  if (camera.kind == scene::Camera::Kind::Orthographic) return {size, 0};
  return {0, size / glm::length(camera.direction)};
}

} // namespace abbe::render
