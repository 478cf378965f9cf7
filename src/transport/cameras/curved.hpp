// SPDX-License-Identifier: MIT
#pragma once

#include "simd/math.hpp"
#include "transport/cameras/camera.hpp"

#include <algorithm>
#include <cmath>

#include <numbers>

namespace abbe::transport {

/// A camera's vectors as unit vectors and lengths, and its angles in radians.
struct CameraFrame {
  explicit CameraFrame(scene::Camera const& camera)
      : right_length(glm::length(camera.right)),
        up_length(glm::length(camera.up)),
        right(camera.right / right_length),
        up(camera.up / up_length),
        ahead(camera.direction / glm::length(camera.direction)),
        across_rad(camera.angle_deg * std::numbers::pi / 180),
        down_rad(camera.vertical_angle_deg * std::numbers::pi / 180) {}
  double right_length, up_length;
  Vec3 right, up, ahead; ///< unit
  double across_rad, down_rad;
  Vec3 sum(double r, double u, double a) const { return r * right + u * up + a * ahead; }
};

/// The angle of a point of the plane about its origin, from -90 degrees up to 270.
inline double turn_of(double x, double y) {
  double const angle = simd::atan2(y, x);
  return x < 0 && y < 0 ? angle + 2 * std::numbers::pi : angle;
}

struct CurvedRay {
  Vec3 origin{0};    ///< relative to the camera's location
  Vec3 direction{0}; ///< of any length; 0: the point shows nothing
};

/// A camera whose rays are found point by point.
/// @tparam Form made of a scene::Camera; ray(a, b): of a point of the picture, a from -1/2 at the
///         left to 1/2, b from -1/2 at the bottom to 1/2; place(a, b): Camera::place;
///         has_one_point: do all rays start at the camera? sees_all: has every point a ray?
///         angle_rad(): that the picture's width shows
template <class Form>
class CurvedCamera final : public Camera {
public:
  explicit CurvedCamera(scene::Camera const& camera) : Camera(camera.location), form_(camera) {}
  bool has_one_point() const override { return Form::has_one_point; }
  bool sees_all() const override { return Form::sees_all; }
  void rays(PicturePoints const& points, geometry::VectorArrays const& origins,
            geometry::VectorArrays const& directions) const override {
    for (std::size_t k = 0; k < points.count; ++k) {
      CurvedRay const ray =
          form_.ray(points.x[k] / points.width - 0.5, 0.5 - points.y[k] / points.height);
      double const length = glm::length(ray.direction);
      origins.set(k, ray.origin);
      directions.set(k, length > 0 ? ray.direction / length : Vec3(0));
    }
  }
  Vec2 place(double a, double b) const override { return form_.place(a, b); }
  Footprint footprint(int width, int height) const override {
    return {0, form_.angle_rad() / std::max(width, height)};
  }

private:
  Form form_;
};

} // namespace abbe::transport
