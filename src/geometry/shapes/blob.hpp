// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/roots.hpp"
#include "geometry/shape.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene blob { [threshold t] components ... [hierarchy] [sturm] }
The points where a field of density is at least t. A component is
`sphere { <x, y, z>, radius, [strength] s ... }`, `cylinder { <end>, <end>, radius, [strength] s ...
}` (with round ends) or `component s, radius, <x, y, z>`; it adds s (1 - (d / radius)^2)^2 where the
distance d from its centre or axis is less than its radius. Components may have transformations and
textures of their own; where several reach, textures mix by what each adds. `hierarchy` and `sturm`
are accepted and have no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| t | number | density | 1 | more than 0 |
| s | number | density | - | any; negative takes away |
| radius | number | length | - | not 0 |

    blob { threshold .5 sphere { <-.4, 0, 0>, 1, 1 } sphere { <.4, 0, 0>, 1, 1 } }
*/
/// Canonical form: scaled by a power of two about the middle of the components. One face, 0.
///
/// Along a line, each component's density is a quartic on one to three intervals; between the ends
/// of these intervals the field is a quartic, which is isolated by roots.hpp. The field's signs at
/// the ends are decided once, for both sides.
class Blob final : public Shape {
public:
  struct Component {
    /// p -> to_unit (p - centre): the unit ball, or the capsule of radius 1 about 0 <= z <= length.
    Mat3 to_unit{1};
    Vec3 centre{0};
    double length = 0; ///< 0: a ball
    double strength = 1;
    int texture = -1;
    // Of the making.
    double reach = 0; ///< of the ball about `middle` that holds it, in object space
    Vec3 middle{0}, low{0}, high{0};
  };
  Blob(std::vector<Component> components, double threshold);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return bounds_; }
  double ball_radius() const override { return ball_; }
  int face_texture(std::uint32_t face) const override;
  std::optional<FaceBlend> face_blend(Vec3 const& point, std::uint32_t face) const override;

private:
  struct Walk;
  /// @param all else what crossings_ahead() has to find
  void find(Ray const& ray, bool all, Crossings& out) const;
  Vec3 gradient(Vec3 const& point) const;

  std::vector<Component> components_;
  double threshold_;
  Bounds bounds_;
  double ball_ = 0;
  bool textured_ = false;
};

std::optional<PlacedShape> make_blob(std::vector<Blob::Component> components, double threshold);
std::optional<PlacedShape> read_blob(Parameters& parameters);

} // namespace abbe::geometry
