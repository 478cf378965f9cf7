// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"
#include "geometry/reach.hpp"

#include <cmath>
#include <memory>

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
  Placed(ShapePtr shape, Transform const& placement);
  explicit Placed(PlacedShape const& placed) : Placed(placed.shape, placed.placement) {}

  Shape const& shape() const { return *shape_; }
  Vec3 const& offset() const { return offset_; }
  /// Of a normal of object space in the world: the direction, not of unit length.
  Vec3 to_world_normal(Vec3 const& n) const {
    return whole_ ? glm::transpose(whole_->inverse_linear) * n : n * inverse_scale_;
  }
  Ray to_object(Ray const& world) const;
  /// The same bits, for any lane type, without the slack.
  template <class L>
  Line<L> line(lane::Vec<L> const& origin, lane::Vec<L> const& direction) const;
  Vec3 to_object(Vec3 const& world_point) const;
  /// The same bits, for any lane type.
  template <class L>
  lane::Vec<L> to_object(lane::Vec<L> const& world_point) const;
  /// Unit normal in world space.
  Vec3 normal(std::uint32_t face, Vec3 const& world_point, bool geometric) const;
  /// The unit normal in world space of a normal of object space, for any lane type: the bits of
  /// normal().
  template <class L>
  lane::Vec<L> to_unit_world_normals(lane::Vec<L> const& n) const;
  /// Unit normal in world space towards what counts as outside (Shape::side).
  Vec3 facing(std::uint32_t face, Vec3 const& world_point) const;
  /// inverse_linear is off by at most `rounding` times this, entry by entry, as described.
  Mat3 inverse_size() const { return whole_ ? whole_->size : Mat3(size_); }
  /// The same along all axes, without sign; 0: not known to be.
  double uniform_scale() const { return whole_ ? 0 : std::fabs(scale_); }
  /// placement.offset is off by at most `rounding` times this.
  Vec3 offset_size() const { return offset_rounding() / rounding; }
  static constexpr double rounding = gamma_bound(16);
  /// As Reach::misses.
  bool misses(Ray const& ray, double until) const {
    if (whole_) return whole_->reach.misses(ray, until);
    return ball_ > 0 && Reach::misses_ball(offset_, ball_, ray, until);
  }
  /// Bounds in world space, wide enough for the errors of to_object. Computed when asked for unless
  /// the placement is kept whole.
  Bounds bounds() const;
  /// Half-spaces of the world that hold all of the inside, but for rounding; of unit normals.
  void half_spaces(std::vector<HalfSpace>& out) const;

private:
  /// Of a normal of object space in the world, of unit length.
  Vec3 to_unit_world_normal(Vec3 const& n) const;
  /// What any placement takes.
  struct Whole {
    Mat3 inverse_linear, size;
    bool along_axes; ///< inverse_linear is diagonal
    Bounds bounds;
    Reach reach;
  };
  /// The same scaling along all axes, without an error but of its inverse, bit by bit?
  static bool uniform(Transform const& at);
  static Whole whole_of(Transform const& at);
  static Bounds bounds_of(Shape const& shape, Transform const& at, Mat3 const& size);
  Vec3 offset_rounding() const { return rounding * glm::abs(offset_) + offset_error_; }

  ShapePtr shape_;
  Vec3 offset_, offset_error_;
  /// Of the same scaling along all axes, which is what a million spheres have; else `whole_`.
  double scale_ = 1, inverse_scale_ = 1, size_ = 1;
  double ball_ = 0; ///< what the reach is, about the offset: squared radius; 0: unknown
  std::unique_ptr<Whole const> whole_;
};

/// As glm has it.
template <class L>
lane::Vec<L> times(Mat3 const& by, lane::Vec<L> const& v) {
  auto const row = [&](int i) { return L(by[0][i]) * v.x + L(by[1][i]) * v.y + L(by[2][i]) * v.z; };
  return {row(0), row(1), row(2)};
}

template <class L>
Line<L> Placed::line(lane::Vec<L> const& origin, lane::Vec<L> const& direction) const {
  auto const vec = [](Vec3 const& v) { return lane::Vec<L>{L(v.x), L(v.y), L(v.z)}; };
  auto const each = [](lane::Vec<L> const& a, lane::Vec<L> const& b) {
    return lane::Vec<L>{a.x * b.x, a.y * b.y, a.z * b.z};
  };
  lane::Vec<L> const from_here = origin - vec(offset_);
  lane::Vec<L> const off = L(rounding) * lane::abs(from_here) + vec(offset_rounding());
  lane::Vec<L> const turned = L(rounding) * lane::abs(direction);
  if (!whole_) { // the same bits with a third of the work
    L const scale(inverse_scale_), size(size_);
    return {scale * from_here, scale * direction, size * off, size * turned, {}};
  }
  Mat3 const &m = whole_->inverse_linear, &s = whole_->size;
  if (whole_->along_axes) {
    lane::Vec<L> const scale = vec({m[0][0], m[1][1], m[2][2]});
    lane::Vec<L> const size = vec({s[0][0], s[1][1], s[2][2]});
    return {
        each(scale, from_here), each(scale, direction), each(size, off), each(size, turned), {}};
  }
  return {times(m, from_here), times(m, direction), times(s, off), times(s, turned), {}};
}

template <class L>
lane::Vec<L> Placed::to_object(lane::Vec<L> const& p) const {
  lane::Vec<L> const from_here = p - lane::Vec<L>{L(offset_.x), L(offset_.y), L(offset_.z)};
  return whole_ ? times(whole_->inverse_linear, from_here) : L(inverse_scale_) * from_here;
}

template <class L>
lane::Vec<L> Placed::to_unit_world_normals(lane::Vec<L> const& n) const {
  lane::Vec<L> world;
  if (!whole_) {
    world = L(inverse_scale_) * n;
  } else if (Mat3 const& back = whole_->inverse_linear; whole_->along_axes) {
    world = {L(back[0][0]) * n.x, L(back[1][1]) * n.y, L(back[2][2]) * n.z};
  } else {
    world = times(glm::transpose(back), n);
  }
  lane::Vec<L> const size = lane::abs(world);
  L const largest = lane::max(size.x, lane::max(size.y, size.z));
  lane::Vec<L> const even = {world.x / largest, world.y / largest, world.z / largest};
  return (L(1.0) / lane::sqrt(lane::dot(even, even))) * even;
}

} // namespace abbe::geometry
