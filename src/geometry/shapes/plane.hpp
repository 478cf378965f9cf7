// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene plane { <normal>, distance }
The half-space on the side of the plane away from its normal. The normal is made of unit length
first; then the plane passes through normal * distance.

| name | type | unit | default | range |
|---|---|---|---|---|
| normal | vector | - | - | not zero |
| distance | number | length | - | any |

    plane { y, 0 }
*/
/// Canonical form: a plane through the origin; its unit normal is its own, as turning it to an axis
/// would only add rounding. One face, 0.
class Plane final : public ConvexShape<Plane> {
public:
  explicit Plane(Vec3 const& unit_normal) : normal_(unit_normal) {}
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::half_space(line, lane::Vec<L>{L(normal_.x), L(normal_.y), L(normal_.z)},
                               L(0.0));
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return true; }
  bool flat(std::uint32_t) const override { return true; }
  bool inside(Vec3 const& point) const override { return glm::dot(normal_, point) <= 0; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return normal_; }
  Bounds bounds() const override;
  void half_spaces(std::vector<HalfSpace>& out) const override { out.push_back({normal_, 0}); }

private:
  Vec3 normal_;
};

std::optional<PlacedShape> make_plane(Vec3 const& normal, double distance);
std::optional<PlacedShape> read_plane(Parameters& parameters);

} // namespace abbe::geometry
