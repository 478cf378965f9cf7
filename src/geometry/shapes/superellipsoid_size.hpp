// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"
#include "simd/lane.hpp"
#include "simd/math.hpp"

#include <limits>

namespace abbe::geometry {

/// The size at a point of places >= 0, and how it grows with each of them.
template <class L>
struct GrownSize {
  L size;
  lane::Vec<L> share;
};

/// ((x^p + y^p)^(q/p) + z^q)^(1/q) for places >= 0.
template <class L>
GrownSize<L> grown_size(lane::Vec<L> const& v, double p, double q) {
  L const zero(0.0), one(1.0);
  struct Pair {
    L size, of_a, of_b;
  };
  // (a^k + b^k)^(1/k) = most (1 + u)^(1/k), u = (least / most)^k.
  auto const joined_pair = [&](L const& a, L const& b, double k) {
    auto const first = b <= a;
    L const most = lane::select(first, a, b);
    L const ratio = lane::select(most == zero, zero, lane::select(first, b, a) / most);
    L const u = lane::exp(L(k) * lane::log(ratio)), whole = one + u;
    L const root = lane::exp(lane::log(whole) * L(1 / k));
    L const of_most = root / whole; // (most / joined)^(k - 1)
    L const at_zero(k > 1 ? 0.0 : k == 1 ? 1.0 : std::numeric_limits<double>::infinity());
    L const of_least = lane::select(ratio == zero, at_zero, of_most * u / ratio);
    return Pair{most * root, lane::select(first, of_most, of_least),
                lane::select(first, of_least, of_most)};
  };
  Pair const ring = joined_pair(v.x, v.y, p), all = joined_pair(ring.size, v.z, q);
  return {all.size, {ring.of_a * all.of_a, ring.of_b * all.of_a, all.of_b}};
}

/// The size of a Superellipsoid as a field, for any powers. Its range over a box that no coordinate
/// plane cuts is that of two corners; eight pieces of a line are looked at side by side.
class SuperellipsoidSize final : public ScalarField {
public:
  SuperellipsoidSize(double p, double q);
  double value(Vec3 const& point) const override;
  bool smooth() const override { return true; }
  bool total() const override { return true; }
  Vec3 gradient(Vec3 const& point) const override;
  Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const override;
  void along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const override;
  int side_by_side() const override { return LinePieces::most; }

  /// A power k of the size.
  struct Power {
    double k;
    double joined; ///< bound of the relative error of (a^k + b^k)^(1/k)
    explicit Power(double of);
  };

private:
  Power p_, q_;
};

} // namespace abbe::geometry
