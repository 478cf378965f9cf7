// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene box { <corner>, <corner> }
A box along the axes between two opposite corners, in any order. One that is flat in x, y or z is a
rectangle, as in POV-Ray: without an inside, as a polygon. One that is flat in two of them is left
out. Both give a warning.

| name | type | unit | default | range |
|---|---|---|---|---|
| corner | vector | length | - | any |
| corner | vector | length | - | different in x, y and z for a body |

    box { <-1, 0, -1>, <1, 2, 1> }
*/
/// Canonical form: the cube [-1, 1]^3. Faces: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z.
class Box final : public ConvexShape<Box> {
public:
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::cube(line);
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return true; }
  bool flat(std::uint32_t) const override { return true; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override;
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;
  double ball_radius() const override { return 0x1.bb67ae8584cabp+0; } // sqrt(3)
};

std::optional<PlacedShape> make_box(Vec3 const& corner, Vec3 const& opposite);
std::optional<PlacedShape> read_box(Parameters& parameters);

} // namespace abbe::geometry
