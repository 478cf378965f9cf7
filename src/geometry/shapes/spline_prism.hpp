// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"
#include "geometry/shapes/spline_pieces.hpp"

#include <vector>

namespace abbe::geometry {

/// Closed curves in the xz plane, drawn out along y: prisms of splines, prisms that run to a point,
/// glyphs.
///
/// Canonical form: Linear, the curves about the origin and -1 <= y <= 1; Conic, the section at
/// height y is the curves times y (of both signs). Where both heights are the same, a patch without
/// an inside. Faces: 0 lid at the lower height, 1 at the upper
/// one, 2 + 2 k + side of piece k, side 1 where the inside is to its left (from x to z).
///
/// The plane through a line and the direction of the sweep (or its apex) cuts the section in a
/// straight line n . (x, 1, z) = 0, so that the line meets a piece where a polynomial of the
/// piece's own degree is zero (roots.hpp). Its signs at the joints are decided once for both
/// pieces, so that crossings match along the line: by turns (EvenOdd) or by the sense in which
/// pieces go round (NonZero).
class SplinePrism final : public Shape {
public:
  using Piece = CurvePiece<2>; ///< x, z
  enum class Sweep : std::uint8_t { Linear, Conic };
  enum class Fill : std::uint8_t { EvenOdd, NonZero };
  struct Form {
    Sweep sweep = Sweep::Linear;
    Fill fill = Fill::EvenOdd;
    double low = -1, high = 1; ///< heights of the lids
    bool open = false;         ///< the lids are not there
  };
  /// @param pieces each ends where another begins, bit by bit
  SplinePrism(std::vector<Piece> pieces, Form const& form);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  bool flat(std::uint32_t face) const override {
    return face < 2 || (form_.sweep == Sweep::Linear && pieces_[(face - 2) / 2].degree == 1);
  }
  bool solid() const override { return form_.low != form_.high; }
  Boundary boundary() const override {
    return !solid() ? Boundary::Sheet : (form_.open ? Boundary::Open : Boundary::Whole);
  }
  Bounds bounds() const override { return bounds_; }
  double ball_radius() const override { return ball_; }

private:
  struct Cut; ///< what a line is in the section
  struct Hull {
    std::array<double, 4> x, z; ///< Bernstein coefficients of a piece
  };
  void piece_crossings(Cut const& cut, std::size_t k, Crossings& out) const;
  void sheet_crossing(Ray const& ray, Crossings& out) const;
  int turned(int turns, bool left) const {
    return form_.fill == Fill::EvenOdd ? 1 - turns : turns + (left ? 1 : -1);
  }
  bool between(Ray const& ray, Crossing& in, Crossing& leave) const;
  void find(Ray const& ray, double from, Crossings& out) const;
  void match(std::size_t first, int turns, Crossing const& in, Crossing const& leave, double from,
             Crossings& out) const;
  bool in_section(double x, double z) const;
  double nearest(Piece const& piece, double x, double z) const;
  void find_bounds();

  std::vector<Piece> pieces_;
  std::vector<Hull> hulls_;
  Form form_;
  Bounds bounds_;
  double reach_ = 0, ball_ = 0; ///< largest coordinate of the curves
};

/// A closed curve: its pieces, in order, the last one ending where the first begins.
using Outline = std::vector<SplinePrism::Piece>;

/// A piece of a glyph's outline: a straight line (2 points), or a Bezier curve of 3 or 4.
SplinePrism::Piece bezier_piece(std::vector<Vec2> const& points);

/// @param y1, y2 heights; of Conic, not both 0; the same: a patch
/// @return nullopt: numbers out of range, or no area
std::optional<PlacedShape> make_spline_prism(std::vector<Outline> outlines, SplinePrism::Sweep,
                                             double y1, double y2, bool open,
                                             SplinePrism::Fill = SplinePrism::Fill::EvenOdd);

} // namespace abbe::geometry
