// SPDX-License-Identifier: MIT
#include "transport/cameras/orthographic.hpp"
#include "transport/cameras/perspective.hpp"

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
  }
  return nullptr;
}

} // namespace abbe::transport
