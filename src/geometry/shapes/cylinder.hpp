// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene cylinder { <base>, <cap>, radius [open] }
A round cylinder between two points. `open` leaves the two lids out; the inside stays the same.

| name | type | unit | default | range |
|---|---|---|---|---|
| base | vector | length | - | any |
| cap | vector | length | - | other than base |
| radius | number | length | - | 0 is left out with a warning |

    cylinder { <0, 0, 0>, <0, 2, 0>, 0.5 open }
*/
/// Canonical form: x^2 + z^2 <= 1, -1 <= y <= 1. Faces: 0 wall, 1 base, 2 cap.
class Cylinder final : public ConvexShape<Cylinder> {
public:
  explicit Cylinder(bool open) : open_(open) {}
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::cylinder(line);
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
  bool open_;
};

std::optional<PlacedShape> make_cylinder(Vec3 const& base, Vec3 const& cap, double radius,
                                         bool open);
std::optional<PlacedShape> read_cylinder(Parameters& parameters);

} // namespace abbe::geometry
