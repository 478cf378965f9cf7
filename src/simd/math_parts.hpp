// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane.hpp"

#include <limits>

/// What the functions of math.hpp are made of: reduced arguments, series, sums of twice the digits.
namespace abbe::simd {

namespace detail {

inline constexpr double shift = 0x1.8p52; ///< x + shift - shift rounds x to a whole number
inline constexpr double ln2_high = 0x1.62e42ffp-1, ln2_low = -0x1.718432a1b0e26p-35;
inline constexpr double per_ln2 = 0x1.71547652b82fep+0;
inline constexpr double largest = std::numeric_limits<double>::infinity();

/// c[0] + x (c[1] + x (c[2] + ...))
template <class L, std::size_t count>
L polynomial(double const (&c)[count], L const& x) {
  L sum(c[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) sum = sum * x + L(c[i]);
  return sum;
}

/// A number of twice the digits.
template <class L>
struct Pair {
  L high, low;
};
/// high + low == a + b exactly. @pre |a| >= |b|, or a == 0
template <class L>
Pair<L> fast_sum(L const& a, L const& b) {
  L const high = a + b;
  return {high, b - (high - a)};
}

/// The same whichever is larger (Knuth).
template <class L>
Pair<L> sum(L const& a, L const& b) {
  L const high = a + b, other = high - a;
  return {high, (a - (high - other)) + (b - other)};
}
/// x to the nearest whole number. @pre 0 <= x
template <class L>
L rounded(L const& x) {
  return select(x < L(0x1p52), (x + L(0x1p52)) - L(0x1p52), x);
}

/// exp(high + low) for |high| <= 1100. Beyond the range of doubles 0 or infinity.
template <class L>
L exp_of(L const& high, L const& low) {
  static constexpr double series[] = {
      1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
      1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  L const k = (high * L(per_ln2) + L(shift)) - L(shift);
  L const r = ((high - k * L(ln2_high)) - k * L(ln2_low)) + low;
  L const value = L(1.0) + (r + r * r * polynomial(series, r));
  // In two steps: 2^k alone may be no normal number.
  L const half = (k * L(0.5) + L(shift)) - L(shift);
  return (value * power_of_two(half + L(shift))) * power_of_two((k - half) + L(shift));
}

/// log(x) for positive, finite x as high + low, to some 62 bits; to 53 when `low` is dropped.
template <class L>
Pair<L> log_of(L const& given) {
  static constexpr double series[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                                      1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23};
  auto const tiny = given < L(0x1p-1022);
  L const x = select(tiny, given * L(0x1p54), given);
  L m = significand(x), k = exponent(x) - select(tiny, L(54.0), L(0.0));
  auto const above = L(0x1.6a09e667f3bcdp+0) < m; // the square root of 2
  m = select(above, m * L(0.5), m);
  k = select(above, k + L(1.0), k);
  // log m = 2 atanh(s), s = f / (2 + f), with what is rounded off of s.
  L const f = m - L(1.0);
  L const d = L(2.0) + f, d_low = f - (d - L(2.0));
  L const inverse = L(1.0) / d;
  L const s = f * inverse;
  L const p = s * d;
  L const s_low = (((f - p) - product_error(s, d, p)) - s * d_low) * inverse;
  L const z = s * s;
  L const rest = L(2.0) * (s_low + s * (z * polynomial(series, z)));
  Pair<L> const sum = fast_sum(k * L(ln2_high), s + s);
  return fast_sum(sum.high, sum.low + (k * L(ln2_low) + rest));
}

/// x - n pi/2 as high + low, |.| <= pi/4 and a little, and n mod 4 in 0..3.
template <class L>
struct Reduced {
  L high, low, quadrant;
};
/// For |x| of any size, by 1280 bits of 2/pi (Payne and Hanek 1983). @pre |x| >= 2^20, finite
Reduced<double> reduce_large(double x);

template <class L>
Reduced<L> reduce_small(L const& x) {
  constexpr double part[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                             0x1.b839a252049c1p-104}; // pi/2 in pieces of 33 bits
  L const n = (x * L(0x1.45f306dc9c883p-1) + L(shift)) - L(shift);
  // The products by the first three are exact.
  L const a = x - n * L(part[0]);
  Pair<L> const b = sum(a, -(n * L(part[1]))), c = sum(b.high, -(n * L(part[2])));
  Pair<L> const r = fast_sum(c.high, (b.low + c.low) - n * L(part[3]));
  L const q = (n * L(0.25) - L(0.375) + L(shift)) - L(shift); // n / 4, rounded down
  return {r.high, r.low, n - L(4.0) * q};
}

template <class L>
Reduced<L> reduce(L const& x) {
  auto const small = abs(x) < L(0x1p20);
  Reduced<L> out = reduce_small(select(small, x, L(0.0)));
  if (none(negate(small))) return out;
  alignas(64) double from[width<L>], high[width<L>], low[width<L>], quadrant[width<L>];
  store(from, x);
  store(high, out.high);
  store(low, out.low);
  store(quadrant, out.quadrant);
  for (std::size_t i = 0; i < width<L>; ++i) {
    if (from[i] < 0x1p20 && from[i] > -0x1p20) continue;
    Reduced<double> const one = reduce_large(from[i]);
    high[i] = one.high;
    low[i] = one.low;
    quadrant[i] = one.quadrant;
  }
  return {load<L>(high), load<L>(low), load<L>(quadrant)};
}

template <class L>
struct SinCos {
  L sin, cos;
};
/// Of an angle between -pi/4 and pi/4, about.
template <class L>
SinCos<L> sin_cos_of(L const& r, L const& low) {
  static constexpr double sines[] = {
      -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  static constexpr double cosines[] = {
      1.0 / 24,        -1.0 / 720,         1.0 / 40320,          -1.0 / 3628800,
      1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000, -1.0 / 6402373705728000};
  L const z = r * r, half = L(0.5) * z, near = L(1.0) - half;
  L const sine = r + (r * z * polynomial(sines, z) + low * near);
  L const cosine = near + (((L(1.0) - near) - half) + (z * z * polynomial(cosines, z) - r * low));
  return {sine, cosine};
}

/// The angle of (x, y) with 0 <= y, 0 <= x, not both 0, both finite; in [0, pi/2].
template <class L>
L angle_of(L const& y, L const& x) {
  static constexpr double series[] = {
      -0x1.5555555555555p-2, 0x1.999999999934ap-3, -0x1.24924924360cbp-3, 0x1.c71c7185314cbp-4,
      -0x1.745d0b26b83e7p-4, 0x1.3b1262d95579ep-4, -0x1.10fa75382537fp-4, 0x1.dfe61e80903d2p-5,
      -0x1.a098bb6ba4941p-5, 0x1.41603647c7a7cp-5, -0x1.3a2b7a07caea9p-6};
  auto const steep = x < y;
  L const low = select(steep, x, y), high = select(steep, y, x);
  auto const wide = L(0.41421356237309503) * high < low; // above pi/8: by the angle to pi/4
  L const t = select(wide, low - high, low) / select(wide, low + high, high);
  L const z = t * t;
  L const angle = t + t * (z * polynomial(series, z));
  L const eighth = select(wide, L(0x1.921fb54442d18p-1), L(0.0)),
          eighth_low = select(wide, L(0x1.1a62633145c07p-55), L(0.0));
  L const direct = eighth + (angle + eighth_low);
  L const other =
      (L(0x1.921fb54442d18p+0) - eighth) + ((L(0x1.1a62633145c07p-54) - eighth_low) - angle);
  return select(steep, other, direct);
}

template <class L>
auto is_nan(L const& x) {
  return negate(x == x);
}

} // namespace detail

} // namespace abbe::simd
