// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shapes/convex.hpp"
#include "geometry/shapes/gap_kernel.hpp"
#include "geometry/shapes/normal_kernel.hpp"
#include "geometry/shapes/quadric_kernel.hpp"

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
class Quadric final : public WithNormalKernel<Quadric, ConvexShape<Quadric>>, public GapKernel {
public:
  explicit Quadric(std::array<double, 10> const& coefficients);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    L const k[10] = {L(k_[0]), L(k_[1]), L(k_[2]), L(0.0),   L(0.0),
                     L(0.0),   L(k_[6]), L(k_[7]), L(k_[8]), L(k_[9])};
    return kernels::convex_quadric(line, k);
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return true; }
  bool one_interval() const override { return convex_; }
  EndsKernel const* ends_kernel() const override { return convex_ ? this : nullptr; }
  GapKernel const* gap_kernel() const override { return convex_ ? nullptr : this; }
  void gap(Line<double> const& line, Gap<double>& out) const override { out = gap_of(line); }
  void gap(Line<lane::Double4> const& lines, Gap<lane::Double4>& out) const override {
    out = gap_of(lines);
  }
#if ABBE_HAS_WIDE_LANES
  ABBE_FOR_AVX2 void gap(Line<lane::Wide4> const& lines, Gap<lane::Wide4>& out) const override {
    out = gap_of(lines);
  }
  ABBE_FOR_AVX512 void gap(Line<lane::Wide8> const& lines, Gap<lane::Wide8>& out) const override {
    out = gap_of(lines);
  }
#endif
  bool inside(Vec3 const& point) const override {
    return value(point) <= 0;
  }
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  template <class L>
  void normal_lanes(lane::Vec<L> const& p, std::uint32_t const*, NormalLanes<L>& out) const {
    auto const k = [&](std::size_t i) { return L(k_[i]); };
    L const two(2.0);
    out.smoothed = unit_lanes<L>({two * (k(0) * p.x) + k(3) * p.y + k(4) * p.z + k(6),
                                  two * (k(1) * p.y) + k(3) * p.x + k(5) * p.z + k(7),
                                  two * (k(2) * p.z) + k(4) * p.x + k(5) * p.y + k(8)},
                                 out.unclear);
  }
  Bounds bounds() const override {
    return bounds_;
  }
  void half_spaces(std::vector<HalfSpace>& out) const override;

  /// A to J, as written.
  std::array<double, 10> const& coefficients() const {
    return k_;
  }

private:
  template <class L>
  Gap<L> gap_of(Line<L> const& line) const {
    L const k[10] = {L(k_[0]), L(k_[1]), L(k_[2]), L(k_[3]), L(k_[4]),
                     L(k_[5]), L(k_[6]), L(k_[7]), L(k_[8]), L(k_[9])};
    return kernels::gap_quadric(line, k);
  }
  double value(Vec3 const& point) const;
  std::array<double, 10> k_;
  Bounds bounds_;
  bool convex_; ///< an ellipsoid, a cylinder, a paraboloid along the axes
};

std::optional<PlacedShape> make_quadric(std::array<double, 10> const& coefficients);
std::optional<PlacedShape> read_quadric(Parameters& parameters);

} // namespace abbe::geometry
