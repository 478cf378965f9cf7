// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <vector>

namespace abbe::geometry {

/** @scene polygon { n, <x, y, z>, ... }
A flat patch with corners in one plane. Several outlines may follow each other, each closed by
repeating its first point (the last is closed in any case); where an even number of them overlap
there is a hole. It has no inside.

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
  explicit Polygon(std::vector<Edge> edges);
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
  Vec2 low_, high_;
};

std::optional<PlacedShape> make_polygon(std::vector<std::vector<Vec3>> const& outlines);
std::optional<PlacedShape> read_polygon(Parameters& parameters);

} // namespace abbe::geometry
