// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene polygon { n, <x, y, z>, ... }
A flat patch with corners in one plane. Several outlines may follow each other, each closed by
repeating its first point (the last is closed in any case); where an even number of them overlap
there is a hole. It has no inside. One whose points are on a line or not in a plane is left out with
a warning.

| name | type | unit | default | range |
|---|---|---|---|---|
| n | integer | - | - | 3 or more |
| <x, y, z> | n vectors | length | - | in one plane, to 2^-20 of the largest distance between them |

    polygon { 5, <0, 0, 0>, <1, 0, 0>, <1, 1, 0>, <0, 1, 0>, <0, 0, 0> }
*/
/// Canonical form: in the plane y = 0, about the origin. One face, 0, its normal +y.
class Polygon final : public Shape {
public:
  struct Edge {
    Vec2 from, to; ///< x, z
  };
  /// @param inner both sides show the interior_texture, as those of POV-Ray's flat boxes
  Polygon(std::vector<Edge> edges, bool inner);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const&) const override { return false; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return {0, 1, 0}; }
  bool flat(std::uint32_t) const override { return true; }
  Bounds bounds() const override;
  bool solid() const override { return false; }
  double ball_radius() const override { return glm::length(high_ - low_) / 2; }

private:
  bool covers(Vec2 const& point) const;
  std::vector<Edge> edges_;
  bool inner_;
  Vec2 low_, high_;
};

/// @param outward where the normal looks to; 0: to either side, by the order of the points
/// @param inner see Polygon
std::optional<PlacedShape> make_polygon(std::vector<std::vector<Vec3>> const& outlines,
                                        Vec3 const& outward = Vec3(0), bool inner = false);
std::optional<PlacedShape> read_polygon(Parameters& parameters);

} // namespace abbe::geometry
