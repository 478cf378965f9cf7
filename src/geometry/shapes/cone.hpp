// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene cone { <base>, base_radius, <cap>, cap_radius [open] }
A cone, or the part of one between two lids. Equal radii make a cylinder. Radii of opposite signs
make two cones that meet in their apex. `open` leaves the lids out.

| name | type | unit | default | range |
|---|---|---|---|---|
| base | vector | length | - | any |
| base_radius | number | length | - | both 0 is left out with a warning |
| cap | vector | length | - | other than base |
| cap_radius | number | length | - | both below 0 count as positive, with a warning |

    cone { <0, 0, 0>, 1, <0, 2, 0>, 0 }
*/
/// Canonical form: axis from y = -1 (base) to y = 1 (cap), the larger radius 1, the radius at y is
/// middle + rate y. Faces: 0 wall, 1 base, 2 cap.
class Cone final : public ConvexShape<Cone> {
public:
  Cone(double middle, double rate, bool open) : middle_(middle), rate_(rate), open_(open) {}
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::cone(line, L(middle_), L(rate_));
  }
  bool visible(std::uint32_t face) const { return !open_ || face == 0; }
  bool ends_visible() const override { return !open_; }
  Boundary boundary() const override { return open_ ? Boundary::Open : Boundary::Whole; }
  bool flat(std::uint32_t face) const override { return face != 0; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override;
  double ball_radius() const override { return 0x1.6a09e667f3bcdp+0; } // sqrt(2)

private:
  double middle_, rate_;
  bool open_;
};

/// The same between radii of opposite signs: both sides of the apex. Faces: 0 wall at the base, 1
/// base, 2 cap, 3 wall at the cap.
class DoubleCone final : public Shape {
public:
  /// @param middle, rate the radius at y is middle + rate y, of either sign
  DoubleCone(double middle, double rate, bool open);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool flat(std::uint32_t face) const override { return face == 1 || face == 2; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return base_.bounds(); }
  double ball_radius() const override { return base_.ball_radius(); }

private:
  Cone base_, cap_;
};

std::optional<PlacedShape> make_cone(Vec3 const& base, double base_radius, Vec3 const& cap,
                                     double cap_radius, bool open);
std::optional<PlacedShape> read_cone(Parameters& parameters);

} // namespace abbe::geometry
