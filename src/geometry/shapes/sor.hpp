// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/roots.hpp"
#include "geometry/shape.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene sor { n, <r, h> ... [open] [sturm] }
A body of revolution about the y axis: between neighbouring heights the square of its radius is a
cubic in h through the points, with the slope at a point of the line between its neighbours. The
first and last point only give slopes. `open` leaves the two lids out. `sturm` is accepted and has
no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| n | integer | - | - | 4 or more |
| <r, h> | n 2-vectors | length | - | r >= 0; heights ascending, but the first and last are free |

    sor { 5, <0, 0>, <.5, .1>, <.3, .5>, <.5, 1>, <.5, 1.1> }
*/
/// Canonical form: scaled by a power of two, the middle height at y = 0. Faces: 0 and 1 the lower
/// and upper lid, 2 + k the k-th piece.
///
/// Along a line, each piece is a cubic in the line's parameter, on the part between two heights.
/// Signs at the heights are decided once, for the lid and the two pieces that meet there.
class Sor final : public Shape {
public:
  /// r^2 = c0 + c1 v + c2 v^2 + c3 v^3, v = (y - low) / (high - low) in [0, 1].
  struct Piece {
    double low, high, inverse; ///< 1 / (high - low), rounded
    double low_square, high_square;
    std::array<double, 4> c;
  };
  Sor(std::vector<Piece> pieces, bool open);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Boundary boundary() const override { return open_ ? Boundary::Open : Boundary::Whole; }
  Bounds bounds() const override;
  double ball_radius() const override { return ball_; }
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;

private:
  struct Walk;
  /// @param all else what crossings_ahead() has to find
  void find(Ray const& ray, bool all, Crossings& out) const;
  /// @return not all, and what is beyond the piece is not asked for
  bool piece_crossings(Walk& walk, std::size_t k, bool all) const;
  Vec3 gradient(Vec3 const& point, Piece const& piece) const;

  std::vector<Piece> pieces_; ///< by ascending heights
  double radius_ = 0, ball_ = 0;
  bool open_;
};

/// @param points <r, h>
std::optional<PlacedShape> make_sor(std::vector<Vec2> points, bool open);
std::optional<PlacedShape> read_sor(Parameters& parameters);

} // namespace abbe::geometry
