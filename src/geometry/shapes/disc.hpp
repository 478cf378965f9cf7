// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene disc { <centre>, <normal>, radius [, hole_radius] }
A flat disc, perhaps with a hole. In boolean operations its inside is the whole half-space behind
the plane of the disc, as for `plane`; its surface is only the ring.

| name | type | unit | default | range |
|---|---|---|---|---|
| centre | vector | length | - | any |
| normal | vector | - | - | 0 is left out with a warning |
| radius | number | length | - | 0 is left out with a warning |
| hole_radius | number | length | 0 | from radius on (a warning), the surface is nowhere |

    disc { <0, 0, 0>, y, 1, 0.5 }
*/
/// Canonical form: about the origin, with its own unit normal and radii. One face, 0.
class Disc final : public ConvexShape<Disc> {
public:
  Disc(Vec3 const& unit_normal, double radius, double hole)
      : normal_(unit_normal), radius_(radius), hole_(hole) {}
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::half_space(line, lane::Vec<L>{L(normal_.x), L(normal_.y), L(normal_.z)},
                               L(0.0));
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return false; } // the hole, and beyond the rim
  bool flat(std::uint32_t) const override { return true; }
  Boundary boundary() const override { return Boundary::Sheet; }
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const& point) const override { return glm::dot(normal_, point) <= 0; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return normal_; }
  Bounds bounds() const override;

private:
  Vec3 normal_;
  double radius_, hole_;
};

std::optional<PlacedShape> make_disc(Vec3 const& centre, Vec3 const& normal, double radius,
                                     double hole);
std::optional<PlacedShape> read_disc(Parameters& parameters);

} // namespace abbe::geometry
