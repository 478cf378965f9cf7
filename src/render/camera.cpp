// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

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

} // namespace abbe::render
