// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"

#include <array>

namespace abbe::geometry {

/** @scene quadric { <A, B, C>, <D, E, F>, <G, H, I>, J }
The surface A x^2 + B y^2 + C z^2 + D xy + E xz + F yz + G x + H y + I z + J = 0; inside where the
left side is negative.

| name | type | unit | default | range |
|---|---|---|---|---|
| A ... J | 3 vectors, a number | - | - | not all of A ... I zero |

    quadric { <1, 0, 1>, <0, 0, 0>, <0, -1, 0>, 0 }
*/
/// Canonical form: the coefficients as given. One face, 0.
class Quadric final : public Shape {
public:
  explicit Quadric(std::array<double, 10> const& coefficients);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  bool inside(Vec3 const& point) const override { return value(point) <= 0; }
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override { return bounds_; }

private:
  double value(Vec3 const& point) const;
  std::array<double, 10> k_;
  Bounds bounds_;
};

std::optional<PlacedShape> make_quadric(std::array<double, 10> const& coefficients);
std::optional<PlacedShape> read_quadric(Parameters& parameters);

} // namespace abbe::geometry
