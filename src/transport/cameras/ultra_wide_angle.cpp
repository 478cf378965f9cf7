// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// Angles grow evenly along both sides of the picture.
struct UltraWideAngle : CameraFrame {
  using CameraFrame::CameraFrame;
  static constexpr bool has_one_point = true, sees_all = true;
  Vec2 place(double a, double b) const {
    return {a * across_rad, b * across_rad * up_length / right_length};
  }
  CurvedRay ray(double a, double b) const {
    Vec2 const at = place(a, b);
    double const x = at.x, y = at.y;
    return {Vec3(0), sum(simd::sin(x), simd::sin(y), simd::cos(x) * simd::cos(y))};
  }
  double angle_rad() const { return across_rad; }
};

} // namespace

std::unique_ptr<Camera const> make_ultra_wide_angle(scene::Camera const& camera) {
  return std::make_unique<CurvedCamera<UltraWideAngle>>(camera);
}

} // namespace abbe::transport
