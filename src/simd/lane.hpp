// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane_types.hpp"
#include "simd/wide_lane.hpp"

#include <cstddef>

/// What the kernels compute with, for any lane type.
namespace abbe::simd {

/// Doubles side by side.
template <class L>
inline constexpr std::size_t width = sizeof(L) / sizeof(double);

/// work.operator()<Lanes>(at) for `count` values, whole lanes from `at` on. Where no more than four
/// are left, four are looked at, however wide L is: arrays are filled up to whole fours.
template <class L, class Work>
void in_lanes(std::size_t count, Work&& work) {
  std::size_t at = 0;
#if ABBE_HAS_WIDE_LANES
  if constexpr (width<L> == 8) {
    for (; at + 4 < count; at += 8) work.template operator()<L>(at);
    if (at < count) work.template operator()<Wide4>(at);
    return;
  }
#endif
  for (; at < count; at += width<L>) work.template operator()<L>(at);
}

template <class L>
L min(L const& a, L const& b) {
  return select(b < a, b, a);
}
template <class L>
L max(L const& a, L const& b) {
  return select(a < b, b, a);
}
/// The smallest of lanes 0 to 3.
template <class L>
double least(L const& v) {
  return min(min(get(v, 0), get(v, 1)), min(get(v, 2), get(v, 3)));
}

/// The rounding error of a * b: a * b == product + the result, exactly (Dekker 1971, Veltkamp's
/// splitting), without a fused multiply-add, which not every machine has.
template <class L>
L product_error(L const& a, L const& b, L const& product) {
  auto const split = [](L const& x) {
    L const big = L(134217729.0) * x;
    return big - (big - x);
  };
  L const ah = split(a), al = a - ah, bh = split(b), bl = b - bh;
  return ((ah * bh - product) + ah * bl + al * bh) + al * bl;
}
/// a b - c d with an error of about one rounding (Kahan).
template <class L>
L difference_of_products(L const& a, L const& b, L const& c, L const& d) {
  L const p = a * b, q = c * d;
  return (p - q) + (product_error(a, b, p) - product_error(c, d, q));
}

template <class L>
struct Vec {
  L x{}, y{}, z{};
  friend Vec operator+(Vec const& a, Vec const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(Vec const& a, Vec const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(L const& s, Vec const& b) { return {s * b.x, s * b.y, s * b.z}; }
};
template <class L>
Vec<L> abs(Vec<L> const& a) {
  return {simd::abs(a.x), simd::abs(a.y), simd::abs(a.z)};
}
template <class L>
L dot(Vec<L> const& a, Vec<L> const& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class L>
L sum(Vec<L> const& a) {
  return a.x + a.y + a.z;
}

} // namespace abbe::simd

namespace abbe {
namespace lane = simd; // what kernels call it
}
