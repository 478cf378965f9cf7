// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"
#include "geometry/shapes/normal_kernel.hpp"

namespace abbe::geometry {

/** @scene sphere { <centre>, radius }
A ball. A negative radius is as good as a positive one.

| name | type | unit | default | range |
|---|---|---|---|---|
| centre | vector | length | - | any |
| radius | number | length | - | 0 is left out with a warning |

    sphere { <0, 1, 0>, 1 }
*/
/// Canonical form: radius 1 about the origin. One face, 0.
class Sphere final : public WithNormalKernel<Sphere, ConvexShape<Sphere>> {
public:
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::sphere(line);
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return true; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  template <class L>
  void normal_lanes(lane::Vec<L> const& points, std::uint32_t const*, NormalLanes<L>& out) const {
    out.smoothed = normalized(points);
  }
  Bounds bounds() const override;
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;
  double ball_radius() const override { return 1; }
};

std::optional<PlacedShape> make_sphere(Vec3 const& centre, double radius);
std::optional<PlacedShape> read_sphere(Parameters& parameters);

} // namespace abbe::geometry
