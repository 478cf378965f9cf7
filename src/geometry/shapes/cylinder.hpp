// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"
#include "geometry/shapes/normal_kernel.hpp"

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
class Cylinder final : public WithNormalKernel<Cylinder, ConvexShape<Cylinder>> {
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
  template <class L>
  void normal_lanes(lane::Vec<L> const& points, std::uint32_t const* faces,
                    NormalLanes<L>& out) const {
    auto const lid = [&](int k) { return faces[k] == 0 ? 0.0 : faces[k] == 1 ? -1.0 : 1.0; };
    L const zero(0.0), up(lid(0), lid(1), lid(2), lid(3));
    auto const side = up == zero;
    lane::Vec<L> const away = normalized(lane::Vec<L>{points.x, zero, points.z});
    out.smoothed = {lane::select(side, away.x, zero), lane::select(side, away.y, up),
                    lane::select(side, away.z, zero)};
  }
  Bounds bounds() const override;
  double ball_radius() const override { return 0x1.6a09e667f3bcdp+0; } // sqrt(2)

private:
  bool open_;
};

std::optional<PlacedShape> make_cylinder(Vec3 const& base, Vec3 const& cap, double radius,
                                         bool open);
std::optional<PlacedShape> read_cylinder(Parameters& parameters);

} // namespace abbe::geometry
