// SPDX-License-Identifier: MIT
#pragma once

#include "transport/cameras/camera.hpp"

namespace abbe::transport {

/// All rays start at the camera.
class PerspectiveCamera final : public Camera {
public:
  explicit PerspectiveCamera(scene::Camera const& camera)
      : Camera(camera.location), camera_(camera) {}
  bool has_one_point() const override { return true; }
  void rays(PicturePoints const& points, geometry::VectorArrays const& origins,
            geometry::VectorArrays const& directions) const override;
  Footprint footprint(int width, int height) const override;

private:
  scene::Camera camera_;
};

} // namespace abbe::transport
