// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"
#include "geometry/reach.hpp"

namespace abbe::geometry {

/// A shape in the world: takes rays to its object space, with bounds of the rounding errors on the
/// way.
///
/// Object space is inverse_linear (p - offset): the difference comes first, so that a shape far
/// from the origin keeps its digits when the ray comes near. The bounds allow 16 roundings for
/// the shape's own canonical form and for to_object itself; where a row has several entries, they
/// are taken as if each were as large as the largest, for a zero (cos 90 degrees) may carry an
/// error relative to its neighbours. What the placement's own bounds say comes on top.
class Placed {
public:
  explicit Placed(PlacedShape const& placed);

  Shape const& shape() const { return *shape_; }
  Vec3 const& offset() const { return offset_; }
  /// Of a normal of object space in the world: the direction, not of unit length.
  Vec3 to_world_normal(Vec3 const& n) const { return glm::transpose(inverse_linear_) * n; }
  Ray to_object(Ray const& world) const;
  /// The same bits, for any lane type, without the slack.
  template <class L>
  Line<L> line(lane::Vec<L> const& origin, lane::Vec<L> const& direction) const;
  Vec3 to_object(Vec3 const& world_point) const;
  /// Unit normal in world space.
  Vec3 normal(std::uint32_t face, Vec3 const& world_point, bool geometric) const;
  /// inverse_linear is off by at most `rounding` times this, entry by entry, as described.
  Mat3 const& inverse_size() const { return size_; }
  /// placement.offset is off by at most `rounding` times this.
  Vec3 offset_size() const { return offset_rounding_ / rounding; }
  static constexpr double rounding = gamma_bound(16);
  Reach const& reach() const { return reach_; }
  /// Bounds in world space, wide enough for the errors of to_object.
  Bounds const& bounds() const { return bounds_; }

private:
  static Bounds bounds_of(PlacedShape const& placed, Mat3 const& size);

  ShapePtr shape_;
  Mat3 inverse_linear_;
  Vec3 offset_;
  Mat3 size_;
  Vec3 offset_rounding_;
  bool along_axes_; ///< inverse_linear is diagonal
  Bounds bounds_;
  Reach reach_;
};

template <class L>
Line<L> Placed::line(lane::Vec<L> const& origin, lane::Vec<L> const& direction) const {
  Mat3 const& m = inverse_linear_;
  auto const vec = [](Vec3 const& v) { return lane::Vec<L>{L(v.x), L(v.y), L(v.z)}; };
  auto const each = [](lane::Vec<L> const& a, lane::Vec<L> const& b) {
    return lane::Vec<L>{a.x * b.x, a.y * b.y, a.z * b.z};
  };
  lane::Vec<L> const from_here = origin - vec(offset_);
  lane::Vec<L> const off = L(rounding) * lane::abs(from_here) + vec(offset_rounding_);
  lane::Vec<L> const turned = L(rounding) * lane::abs(direction);
  if (along_axes_) {
    lane::Vec<L> const scale = vec({m[0][0], m[1][1], m[2][2]});
    lane::Vec<L> const size = vec({size_[0][0], size_[1][1], size_[2][2]});
    return {
        each(scale, from_here), each(scale, direction), each(size, off), each(size, turned), {}};
  }
  auto const times = [](Mat3 const& by, lane::Vec<L> const& v) {
    auto const row = [&](int i) {
      return L(by[0][i]) * v.x + L(by[1][i]) * v.y + L(by[2][i]) * v.z;
    };
    return lane::Vec<L>{row(0), row(1), row(2)};
  };
  return {times(m, from_here), times(m, direction), times(size_, off), times(size_, turned), {}};
}

} // namespace abbe::geometry
