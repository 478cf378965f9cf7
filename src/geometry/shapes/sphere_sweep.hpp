// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"
#include "geometry/shapes/spline_pieces.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene sphere_sweep { linear_spline | cubic_spline | b_spline n, <x, y, z>, r, ... [tolerance t]
} All that a ball passes whose centre and radius go along a curve. A cubic spline goes from its
second to its last but one point, a b_spline near its points. `tolerance` is accepted and has no
effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| n | integer | - | - | 2 (linear), 4 or more |
| <x, y, z>, r | n vectors and radii | length | - | some radius not 0 |

    sphere_sweep { linear_spline 2, <0, 0, 0>, .2, <1, 0, 0>, .1 }
*/
/// Canonical form: scaled by a power of two about its middle. Face: the piece.
///
/// Of the balls of a piece, those that a line meets are where a polynomial of degree six in u is
/// positive; on each such stretch of u the parts of the line within the balls make up one interval,
/// from the least t in to the largest t out. These are at roots of a polynomial of degree ten (the
/// derivative of t by u) or at ends of the piece. What all the intervals cover is inside.
class SphereSweep final : public Shape {
public:
  using Piece = CurvePiece<4>; ///< x, y, z, radius
  explicit SphereSweep(std::vector<Piece> pieces);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return bounds_; }
  double ball_radius() const override { return ball_; }

private:
  struct Walk;
  struct Ball {
    Vec3 centre;
    double radius;
  };
  /// The u of the piece's ball that the point is deepest in, and how far it is from its surface
  /// (squares; negative inside).
  static double deepest(Piece const& piece, Vec3 const& point, double& depth);

  std::vector<Piece> pieces_;
  std::vector<Ball> balls_; ///< each holds a piece
  Bounds bounds_;
  double ball_ = 0;
};

/// @param points x, y, z, radius
std::optional<PlacedShape> make_sphere_sweep(SplineKind kind,
                                             std::vector<std::array<double, 4>> points);
std::optional<PlacedShape> read_sphere_sweep(Parameters& parameters);

} // namespace abbe::geometry
