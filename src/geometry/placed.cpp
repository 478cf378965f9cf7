// SPDX-License-Identifier: MIT
#include "geometry/placed.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

Placed::Placed(PlacedShape const& placed)
    : shape_(placed.shape),
      inverse_linear_(placed.placement.inverse_linear),
      offset_(placed.placement.offset),
      size_(0),
      along_axes_(false) {
  Transform const& at = placed.placement;
  offset_rounding_ = rounding * glm::abs(at.offset) + at.offset_error;
  Mat3 const& m = at.inverse_linear;
  along_axes_ = m == Mat3(m[0][0], 0, 0, 0, m[1][1], 0, 0, 0, m[2][2]);
  for (int row = 0; row < 3; ++row) {
    int entries = 0;
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
      double const entry = std::fabs(m[column][row]);
      entries += entry != 0 ? 1 : 0;
      largest = std::fmax(largest, entry);
    }
    for (int column = 0; column < 3; ++column) {
      bool const none = entries == 1 && m[column][row] == 0;
      double const off = at.inverse_linear_error[column][row];
      size_[column][row] = (none ? 0.0 : largest) + off / rounding;
      along_axes_ = along_axes_ && (row == column || off == 0);
    }
  }
  bounds_ = bounds_of(placed, size_);
  reach_ = Reach(*this, placed.placement);
}

Ray Placed::to_object(Ray const& world) const {
  Vec3 const from_here = world.origin - offset_;
  Ray ray;
  if (along_axes_) { // the same bits with a third of the work
    Vec3 const scale(inverse_linear_[0][0], inverse_linear_[1][1], inverse_linear_[2][2]);
    Vec3 const size(size_[0][0], size_[1][1], size_[2][2]);
    ray.origin = scale * from_here;
    ray.direction = scale * world.direction;
    ray.origin_error = size * world.origin_error;
    ray.origin_rounding = size * (rounding * glm::abs(from_here) + offset_rounding_);
    ray.direction_rounding = size * (rounding * glm::abs(world.direction));
    return ray;
  }
  ray.origin = inverse_linear_ * from_here;
  ray.direction = inverse_linear_ * world.direction;
  ray.origin_error = size_ * world.origin_error;
  ray.origin_rounding = size_ * (rounding * glm::abs(from_here) + offset_rounding_);
  ray.direction_rounding = size_ * (rounding * glm::abs(world.direction));
  return ray;
}

Vec3 Placed::to_object(Vec3 const& world_point) const {
  return inverse_linear_ * (world_point - offset_);
}

Vec3 Placed::normal(std::uint32_t face, Vec3 const& world_point, bool geometric) const {
  Vec3 const point = to_object(world_point);
  Vec3 const n = geometric ? shape().geometric_normal(point, face) : shape().normal(point, face);
  // The direction only: scaled to the order of 1 first, so that no square overflows.
  Mat3 const& back = inverse_linear_;
  Vec3 const world =
      along_axes_ ? n * Vec3(back[0][0], back[1][1], back[2][2]) : to_world_normal(n);
  Vec3 const size = glm::abs(world);
  double const largest = std::max(size.x, std::max(size.y, size.z));
  return glm::normalize(world / largest);
}

Bounds Placed::bounds_of(PlacedShape const& placed, Mat3 const& inverse_size) {
  Bounds const own = placed.shape->bounds();
  if (own.infinite || own.empty()) return own;
  Transform const& at = placed.placement;
  Mat3 const size(glm::abs(at.linear[0]), glm::abs(at.linear[1]), glm::abs(at.linear[2]));
  Vec3 const middle = own.low * 0.5 + own.high * 0.5, half = own.high * 0.5 - own.low * 0.5;
  Vec3 const centre = at.point(middle);
  Vec3 const reach = size * half;
  Vec3 const far = size * glm::abs(middle) + reach;
  // What to_object is off by, taken back to the world.
  Vec3 const off = at.offset_error + at.linear_error * (glm::abs(middle) + half)
                   + size * (at.inverse_linear_error * far + inverse_size * at.offset_error);
  Vec3 const wide = reach + gamma_bound(64) * (far + glm::abs(at.offset)) + off;
  return {centre - wide, centre + wide, false};
}

} // namespace abbe::geometry
