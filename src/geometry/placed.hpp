// SPDX-License-Identifier: MIT
#pragma once

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

} // namespace abbe::geometry
