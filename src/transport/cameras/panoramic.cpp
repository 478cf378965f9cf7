// SPDX-License-Identifier: MIT
#include "transport/cameras/curved.hpp"
#include "transport/cameras/projections.hpp"

namespace abbe::transport {
namespace {

/// Half of a turn across, and from straight down to straight up, with lines that stay upright. Its
/// angle is fixed; the lengths of the camera's vectors stretch it.
struct Panoramic {
  explicit Panoramic(scene::Camera const& c) : right(c.right), up(c.up), ahead(c.direction) {}
  static constexpr bool has_one_point = true, sees_all = true;
  Vec3 right, up, ahead;
  Vec2 place(double a, double b) const {
    return {(0.5 - a) * std::numbers::pi, b * std::numbers::pi};
  }
  CurvedRay ray(double a, double b) const {
    Vec2 const at = place(a, b);
    double const x = at.x, y = at.y;
    // cos(x), tan(y), sin(x), times cos(y): straight up is no larger than all else.
    double const level = simd::cos(y);
    return {Vec3(0),
            simd::cos(x) * level * right + simd::sin(y) * up + simd::sin(x) * level * ahead};
  }
  double angle_rad() const { return std::numbers::pi; }
};

} // namespace

std::unique_ptr<Camera const> make_panoramic(scene::Camera const& camera) {
  return std::make_unique<CurvedCamera<Panoramic>>(camera);
}

} // namespace abbe::transport
