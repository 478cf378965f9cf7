// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

namespace abbe::geometry {

/** @scene torus { major_radius, minor_radius [sturm] }
A ring about the y axis. With minor_radius > major_radius the tube overlaps itself; the inside is
all that the tube sweeps over. `sturm` is accepted and has no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| major_radius | number | length | - | 0 makes a sphere; below 0 counts as positive, with a warning
| | minor_radius | number | length | - | 0 is left out, below 0 counts as positive, both with a
warning |

    torus { 1, 0.25 }
*/
/// Canonical form: the radii as given. One face, 0.
///
/// Roots (research 3.3): the line is moved to its closest approach to the centre, cut to the
/// bounding sphere and slab, and that window scaled to [-1, 1]. The critical points of the quartic
/// there, found by nested bracketing, part it into monotone pieces; signs and roots are taken from
/// the factored (rho - R)^2 + y^2 - r^2, never from the expanded quartic, which mixes r^2 with R^4.
class Torus final : public Shape {
public:
  Torus(double major, double minor) : major_(major), minor_(minor) {}
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override;
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;
  double ball_radius() const override { return major_ + minor_; }

private:
  /// @param all else what crossings_ahead() has to find
  void roots(Ray const& ray, bool all, Crossings& out) const;
  double major_, minor_;
};

std::optional<PlacedShape> make_torus(double major, double minor);
std::optional<PlacedShape> read_torus(Parameters& parameters);

} // namespace abbe::geometry
