// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/line.hpp"
#include "geometry/shape.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene prism { [linear_spline | quadratic_spline | cubic_spline | bezier_spline] [linear_sweep |
conic_sweep] y1, y2, n, <x, z> ... [open] [sturm] }
A curve in the xz plane, drawn out along y, or (conic_sweep) to the origin, so that it is as given
at y = 1. Several outlines may follow each other, each closed by repeating its first point; where
an even number of them overlap there is a hole. A quadratic_spline has one point more in front of
each outline, a cubic_spline one in front and one behind: these give slopes only. A bezier_spline
has four points a piece. `open` leaves the two lids out; `sturm` has no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| y1, y2 | numbers | length | - | any; the same: a patch |
| n | integer | - | - | 3 (linear), 5 (quadratic), 6 (cubic), 4 (bezier) or more |
| <x, z> | n 2-vectors | length | - | any |

    prism { 0, 1, 4, <0, 0>, <1, 0>, <0, 1>, <0, 0> }
*/
/// A prism of straight lines and a linear sweep; others are a SplinePrism.
///
/// Canonical form: -1 <= y <= 1, the points about the origin. Faces: 0 lid at y = -1, 1 lid at y =
/// 1, 2 + k edge k. A line is compared with each corner once, so that no line slips between two
/// edges.
class Prism final : public Shape {
public:
  using Contour = std::vector<Vec2>; ///< closed; the first point is not repeated
  Prism(std::vector<Contour> const& contours, bool open);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Boundary boundary() const override { return open_ ? Boundary::Open : Boundary::Whole; }
  Bounds bounds() const override;
  double ball_radius() const override { return glm::length(bounds().high - bounds().low) / 2; }

private:
  struct Edge {
    Vec2 from, to;
    Vec2 outward; ///< not of unit length
  };
  bool in_polygon(Vec2 const& point, Edge const* skip) const;
  void edge_crossings(Line<double> const& line, Crossings& out) const;

  std::vector<Edge> edges_;
  Vec2 low_, high_;
  bool open_;
};

std::optional<PlacedShape> make_prism(std::vector<Prism::Contour> contours, double y1, double y2,
                                      bool open);
std::optional<PlacedShape> read_prism(Parameters& parameters);

} // namespace abbe::geometry
