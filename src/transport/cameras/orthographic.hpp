// SPDX-License-Identifier: MIT
#pragma once

#include "transport/cameras/camera.hpp"

namespace abbe::transport {

/// All rays have one direction, and start on the plane of the picture.
class OrthographicCamera final : public Camera {
public:
  explicit OrthographicCamera(scene::Camera const& camera)
      : Camera(camera.location), camera_(camera) {}
  bool has_one_point() const override { return false; }
  void rays(PicturePoints const& points, geometry::VectorArrays const& origins,
            geometry::VectorArrays const& directions) const override;
  Footprint footprint(int width, int height) const override;

private:
  scene::Camera camera_;
};

} // namespace abbe::transport
