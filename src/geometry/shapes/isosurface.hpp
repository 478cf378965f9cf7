// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <memory>

namespace abbe::geometry {

/** @scene isosurface { function { ... } [contained_by { box { corner, corner } | sphere { centre,
radius } }] [threshold t] [accuracy a] [open] ... } The points of the container where a function of
x, y and z is at most the threshold. Where the container cuts them there is a surface, unless it is
`open`. Roots are found by interval arithmetic on the function itself, so none is missed and no
gradient needs to be known: `max_gradient`, `evaluate`, `max_trace` and `all_intersections` are
accepted and have no effect. `accuracy` counts only where the function has steps or patterns in it:
sides that change and change back within it may go unseen.

| name | type | unit | default | range |
|---|---|---|---|---|
| contained_by | box or sphere | length | box { -1, 1 } | not flat |
| t | number | - | 0 | any |
| a | number | length | 0.001 | more than 0 |

    isosurface { function { x*x + 2*y*y + z*z - .5 } contained_by { box { -1, 1 } } }
*/
/// Canonical form: as given. Faces: 0 the surface, 1 + 2 axis + upper of a box, 7 of a ball.
class Isosurface final : public Shape {
public:
  struct Container {
    bool ball = false;
    Vec3 low{-1}, high{1}; ///< of a box, and the bounds of a ball
    Vec3 centre{0};
    double radius = 0;
  };
  Isosurface(std::shared_ptr<ScalarField const> field, Container const& container, double threshold,
             double accuracy, bool open);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Boundary boundary() const override { return open_ ? Boundary::Open : Boundary::Whole; }
  Bounds bounds() const override { return {container_.low, container_.high, false}; }
  double ball_radius() const override;

private:
  bool contained(Ray const& ray, Crossing& in, Crossing& out) const;
  void between(Ray const& ray, double from, double until, double enough, Crossings& out) const;

  std::shared_ptr<ScalarField const> field_;
  Container container_;
  double threshold_, accuracy_;
  bool open_;
};

std::optional<PlacedShape> read_isosurface(Parameters& parameters);

} // namespace abbe::geometry
