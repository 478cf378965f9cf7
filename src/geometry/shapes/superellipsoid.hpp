// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shapes/convex.hpp"

#include <memory>
#include <vector>

namespace abbe::geometry {

class SuperellipsoidSize;
struct CloseLine;
struct FieldLine;

/** @scene superellipsoid { <e, n> }
The body (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1: a sphere for <1, 1>, a box as both go to 0.

| name | type | unit | default | range |
|---|---|---|---|---|
| e, n | numbers | - | - | more than 0 |

    superellipsoid { <.25, .25> }
*/
/// Canonical form: as given; within the cube [-1, 1]^3. One face, 0.
///
/// Its size at a point, ((|x|^p + |y|^p)^(q/p) + |z|^q)^(1/q) with p = 2/e and q = 2/n, grows with
/// |x|, |y| and |z|. Where both powers are at least 1 it is a norm: along a line it falls, then
/// rises, and Newton's method from both sides comes to its two roots without passing them, for
/// several lines at once. Else
/// field_roots finds where it passes 1 (superellipsoid_size.hpp).
class Superellipsoid final : public ConvexShape<Superellipsoid> {
public:
  Superellipsoid(double east, double north);
  ~Superellipsoid() override;
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  template <class L>
  Slice<L> slice(Line<L> const& line) const;
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return true; }
  bool one_interval() const override { return convex_; }
  EndsKernel const* ends_kernel() const override { return convex_ ? this : nullptr; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return {{-1, -1, -1}, {1, 1, 1}, false}; }
  double ball_radius() const override { return ball_; }

private:
  template <class L>
  struct Local;
  template <class L>
  Local<L> local(lane::Vec<L> const& point, lane::Vec<L> const& direction) const;

  /// Crossings of the pieces from `from` to `until`, up to the first that is beyond `enough`.
  void search(CloseLine const& close, double from, double until, double enough,
              Crossings& out) const;
  void cut_by_faces(FieldLine const& line, double& low, double& high) const;

  double p_, q_;
  bool convex_;
  std::shared_ptr<SuperellipsoidSize const> size_;
  double ball_;
  std::vector<Vec3> faces_; ///< n of planes n . |v| = 1 that it lies within, where not convex
};

std::optional<PlacedShape> make_superellipsoid(double east, double north);
std::optional<PlacedShape> read_superellipsoid(Parameters& parameters);

} // namespace abbe::geometry
