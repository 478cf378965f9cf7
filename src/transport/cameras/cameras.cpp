// SPDX-License-Identifier: MIT
#include "transport/cameras/orthographic.hpp"
#include "transport/cameras/perspective.hpp"
#include "transport/cameras/projections.hpp"

#include <algorithm>

namespace abbe::transport {

double pixel_size(scene::Camera const& camera, int width, int height) {
  double const across = glm::length(camera.right) / width, down = glm::length(camera.up) / height;
  // A camera that sees along one plane may have no height.
  return across > 0 && down > 0 ? std::min(across, down) : std::max(across, down);
}

std::unique_ptr<Camera const> make_camera(scene::Camera const& camera) {
  using Kind = scene::Camera::Kind;
  switch (camera.kind) {
  case Kind::Perspective:
    return std::make_unique<PerspectiveCamera>(camera);
  case Kind::Orthographic:
    return std::make_unique<OrthographicCamera>(camera);
  case Kind::Fisheye:
    return make_fisheye(camera);
  case Kind::UltraWideAngle:
    return make_ultra_wide_angle(camera);
  case Kind::Omnimax:
    return make_omnimax(camera);
  case Kind::Panoramic:
    return make_panoramic(camera);
  case Kind::Cylinder:
    return make_cylinder(camera);
  case Kind::Spherical:
    return make_spherical(camera);
  case Kind::Mesh:
    return make_mesh_camera(camera);
  }
  return nullptr;
}

} // namespace abbe::transport
