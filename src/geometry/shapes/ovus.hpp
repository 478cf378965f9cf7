// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

namespace abbe::geometry {

/** @scene ovus { bottom, top }
An egg about the y axis: a ball of the radius `bottom` about the origin, one of the radius `top`
about <0, bottom, 0>, and around both an arc of twice the larger radius that goes on from them
smoothly. Where `top` is twice `bottom` or more, the upper ball alone.

| name | type | unit | default | range |
|---|---|---|---|---|
| bottom, top | numbers | length | - | 0 or more, not both 0 |

    ovus { 1, .65 }
*/
/// Canonical form: scaled by a power of two. Faces: 0 lower ball, 1 the arc, 2 upper ball.
///
/// The egg is convex, and so is the distance to its surface, negative inside: along a line it
/// falls, then rises, and Newton's method from both sides comes to the two roots without passing
/// them.
class Ovus final : public Shape {
public:
  Ovus(double bottom, double top);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool one_interval() const override { return true; }
  bool inside(Vec3 const& point) const override { return distance(point).value < 0; }
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return bounds_; }
  double ball_radius() const override { return ball_; }
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;

private:
  struct Local {
    double value; ///< the distance
    Vec3 outward; ///< its gradient, of unit length
    std::uint32_t face;
  };
  Local distance(Vec3 const& point) const;
  Local distance(Vec3 const& point, std::uint32_t face) const;

  double bottom_, top_, arc_;     ///< radii
  double away_, height_;          ///< of the arc's middle: distance beyond the axis, and y
  double low_joint_, high_joint_; ///< heights of the circles where the arc begins and ends
  Bounds bounds_;
  double ball_;
};

std::optional<PlacedShape> make_ovus(double bottom, double top);
std::optional<PlacedShape> read_ovus(Parameters& parameters);

} // namespace abbe::geometry
