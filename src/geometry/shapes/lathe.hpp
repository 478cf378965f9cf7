// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"
#include "geometry/shapes/spline_pieces.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene lathe { [linear_spline | quadratic_spline | cubic_spline | bezier_spline] n, <r, y> ...
[sturm] } A curve in the plane of distance r and height y, turned about the y axis. Inside is where
a line straight outward from the axis meets the curve an odd number of times; so a curve with free
ends is closed by level lids that are not seen. The first and last point of a cubic spline, and the
first of a quadratic one, only give slopes; a bezier spline has four points for each piece. `sturm`
is accepted and has no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| n | integer | - | - | 2, 3 (quadratic), 4 (cubic) or more; a multiple of 4 (bezier) |
| <r, y> | n 2-vectors | length | - | any |

    lathe { linear_spline 4, <0, 0>, <.5, 0>, <.3, 1>, <0, 1> }
*/
/// Canonical form: scaled by a power of two, the middle height at y = 0. Faces: 2 k + side for the
/// k-th piece, side 1 where the inside is to the right of the curve; then the
/// lids in the same way, side 1 where the inside is above.
///
/// A line turned about the axis is a hyperboloid; with r and y cubics in u it meets the curve where
/// a polynomial of degree six is zero (roots.hpp). Its signs at the joints are decided once for
/// both pieces and the lid that ends there, so that crossings alternate. Level lines (to 2^-40 of
/// their length) meet the curve where y(u) is their height, twice each.
class Lathe final : public Shape {
public:
  using Piece = CurvePiece<2>; ///< r, y
  explicit Lathe(std::vector<Piece> pieces);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Boundary boundary() const override { return lids_.empty() ? Boundary::Whole : Boundary::Open; }
  Bounds bounds() const override;
  double ball_radius() const override { return ball_; }
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;

private:
  struct Turned; ///< a line, turned about the axis
  struct Box {
    double low, high, radius; ///< of a piece
  };
  struct Lid {
    double radius, height;
  };
  void level_crossings(Turned const& line, Crossings& out) const;
  void piece_crossings(Turned& line, std::size_t k, Crossings& out) const;
  /// u of the place on the piece that is nearest to the point.
  double nearest(Piece const& piece, Vec3 const& point) const;

  std::vector<Piece> pieces_;
  std::vector<Box> boxes_;
  std::vector<Lid> lids_; ///< at ends that no other piece goes on from
  double radius_ = 0, low_ = 0, high_ = 0, ball_ = 0;
};

std::optional<PlacedShape> make_lathe(SplineKind kind, std::vector<Vec2> const& points);
std::optional<PlacedShape> read_lathe(Parameters& parameters);

} // namespace abbe::geometry
