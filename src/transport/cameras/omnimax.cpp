// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// The lens of an Omnimax theatre: a fisheye whose angle is a polynomial of the distance from the
/// middle, cut off 45 degrees below the horizon. A wide picture shows the circle's top at its own
/// and leaves out what is below; one so wide that all above the cut is in it gets wider margins.
struct Omnimax : CameraFrame {
  static constexpr bool has_one_point = true, sees_all = false;
  /// Where the polynomial is 45 degrees.
  static constexpr double cut = 0.5582906057151604;

  explicit Omnimax(scene::Camera const& camera) : CameraFrame(camera) {
    double const shape = up_length / right_length;
    double const least = (1 + cut) / 2;
    scale_y = std::max(shape, least);
    scale_x = scale_y / shape;
    offset_y = std::max(0.0, 1 - scale_y);
  }
  double scale_x, scale_y, offset_y;

  /// A point on the circle whose radius is 1.
  Vec2 on_circle(double a, double b) const { return {2 * a * scale_x, 2 * b * scale_y + offset_y}; }
  /// The angle from the axis.
  static double theta_of(double radius) {
    double const radius2 = radius * radius;
    return radius * (1.411269 + radius2 * (-0.09439 + radius2 * 0.25674));
  }
  /// The angles about the axis and from it.
  Vec2 place(double a, double b) const {
    Vec2 const at = on_circle(a, b);
    return {turn_of(at.x, at.y), theta_of(glm::length(at))};
  }

  CurvedRay ray(double a, double b) const {
    Vec2 const at = on_circle(a, b);
    double const x = at.x, y = at.y;
    double const radius2 = x * x + y * y;
    if (radius2 > 1) return {};
    double const radius = std::sqrt(radius2), theta = theta_of(radius);
    double const aside = radius > 0 ? simd::sin(theta) / radius : 0, forward = simd::cos(theta);
    if (y * aside < -forward) return {};
    return {Vec3(0), sum(x * aside, y * aside, forward)};
  }
  double angle_rad() const { return std::numbers::pi; }
};

} // namespace

std::unique_ptr<Camera const> make_omnimax(scene::Camera const& camera) {
  return std::make_unique<CurvedCamera<Omnimax>>(camera);
}

} // namespace abbe::transport
