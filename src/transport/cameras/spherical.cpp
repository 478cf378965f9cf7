// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// Longitude across, latitude down: what a picture wrapped around a sphere shows from within. The
/// direction is turned about `right`, then about `up`, whichever way these point.
struct Spherical : CameraFrame {
  using CameraFrame::CameraFrame;
  static constexpr bool has_one_point = true, sees_all = true;
  Vec2 place(double a, double b) const { return {a * across_rad, b * down_rad}; }
  CurvedRay ray(double a, double b) const {
    Vec2 const at = place(a, b);
    return {Vec3(0), turned(turned(ahead, right, -at.y), up, at.x)};
  }
  /// Rodrigues' rotation.
  static Vec3 turned(Vec3 const& v, Vec3 const& axis, double angle_rad) {
    double const c = simd::cos(angle_rad), s = simd::sin(angle_rad);
    return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
  }
  double angle_rad() const { return std::max(across_rad, down_rad); }
};

} // namespace

std::unique_ptr<Camera const> make_spherical(scene::Camera const& camera) {
  return std::make_unique<CurvedCamera<Spherical>>(camera);
}

} // namespace abbe::transport
