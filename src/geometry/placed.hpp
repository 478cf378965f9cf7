// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

namespace abbe::geometry {

/// A shape in the world: takes rays to its object space, with bounds of the rounding errors on the
/// way.
///
/// Object space is inverse_linear (p - offset): the difference comes first, so that a shape far
/// from the origin keeps its digits when the ray comes near. The bounds allow 16 roundings for
/// matrices that are products of several; where a row has several entries, they are taken as if
/// each were as large as the largest, for a zero (cos 90 degrees) may carry an error relative to
/// its neighbours.
class Placed {
public:
  explicit Placed(PlacedShape placed);

  PlacedShape const& source() const { return source_; }
  Shape const& shape() const { return *source_.shape; }
  Ray to_object(Ray const& world) const;
  Vec3 to_object(Vec3 const& world_point) const;
  /// Unit normal in world space.
  Vec3 normal(std::uint32_t face, Vec3 const& world_point, bool geometric) const;
  /// Bounds of |inverse_linear|, entry by entry, as described.
  Mat3 const& inverse_size() const { return size_; }
  /// Bounds in world space, wide enough for the errors of to_object.
  Bounds bounds() const;

private:
  PlacedShape source_;
  Mat3 size_;
  bool along_axes_; ///< inverse_linear is diagonal
};

} // namespace abbe::geometry
