// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// The picture lies on a cylinder: upright (1, 3) or lying (2, 4); rays come from its middle (1, 2)
/// or are square to its axis (3, 4).
template <int Type>
struct Cylinder : CameraFrame {
  using CameraFrame::CameraFrame;
  static constexpr bool has_one_point = Type <= 2, sees_all = true;
  static constexpr bool upright = Type % 2 == 1;
  /// The angle and the way along the axis, as they lie in the picture.
  Vec2 place(double a, double b) const {
    return upright ? Vec2(a * across_rad, b * up_length) : Vec2(a * right_length, b * across_rad);
  }
  CurvedRay ray(double a, double b) const {
    Vec2 const at = place(a, b);
    double const turn = upright ? at.x : at.y, along = upright ? at.y : at.x;
    double const aside = simd::sin(turn), forward = simd::cos(turn);
    Vec3 const round = upright ? sum(aside, 0, forward) : sum(0, aside, forward);
    Vec3 const axis = along * (upright ? up : right);
    return has_one_point ? CurvedRay{Vec3(0), round + axis} : CurvedRay{axis, round};
  }
  double angle_rad() const { return across_rad; }
};

} // namespace

std::unique_ptr<Camera const> make_cylinder(scene::Camera const& camera) {
  switch (camera.cylinder_type) {
  case 1:
    return std::make_unique<CurvedCamera<Cylinder<1>>>(camera);
  case 2:
    return std::make_unique<CurvedCamera<Cylinder<2>>>(camera);
  case 3:
    return std::make_unique<CurvedCamera<Cylinder<3>>>(camera);
  default:
    return std::make_unique<CurvedCamera<Cylinder<4>>>(camera);
  }
}

} // namespace abbe::transport
