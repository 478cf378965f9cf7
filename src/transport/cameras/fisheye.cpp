// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// Angles from the axis grow with the distance from the middle of a circle, outside of which
/// nothing is seen.
struct Fisheye : CameraFrame {
  using CameraFrame::CameraFrame;
  static constexpr bool has_one_point = true, sees_all = false;
  CurvedRay ray(double a, double b) const {
    double const x = 2 * a * right_length, y = 2 * b * up_length;
    double const radius = std::sqrt(x * x + y * y);
    if (radius > 1) return {};
    if (radius == 0) return {Vec3(0), ahead};
    double const theta = radius * across_rad / 2, aside = simd::sin(theta) / radius;
    return {Vec3(0), sum(x * aside, y * aside, simd::cos(theta))};
  }
  /// The angles about the axis and from it.
  Vec2 place(double a, double b) const {
    double const x = 2 * a * right_length, y = 2 * b * up_length;
    return {turn_of(x, y), std::sqrt(x * x + y * y) * across_rad / 2};
  }
  double angle_rad() const { return across_rad * std::max(right_length, up_length); }
};

} // namespace

std::unique_ptr<Camera const> make_fisheye(scene::Camera const& camera) {
  return std::make_unique<CurvedCamera<Fisheye>>(camera);
}

} // namespace abbe::transport
