// SPDX-License-Identifier: MIT
#pragma once

#include "simd/math_parts.hpp"

/// Exponentials, logarithms and trigonometry for any lane type L, made of + - * / and square roots
/// alone: the same bits on every processor and in every width of registers, which the C library
/// does not promise. Special values are those of C99 (Annex F).
///
/// Errors in units in the last place, as tests/unit/simd measures them against 113-bit numbers:
/// exp, log, sin, cos 1; tan, asin, acos, atan, atan2 2.5; pow 1.5 + |y log x| / 50.
/// @source argument reduction: Cody & Waite 1980; logarithm by atanh: Muller, Elementary Functions
namespace abbe::simd {

template <class L>
L exp(L const& x) {
  L const clamped = select(L(710.0) < x, L(710.0), select(x < L(-746.0), L(-746.0), x));
  L const value = detail::exp_of(select(detail::is_nan(x), L(0.0), clamped), L(0.0));
  return select(detail::is_nan(x), x, value);
}

template <class L>
L log(L const& x) {
  auto const usual = both(L(0.0) < x, x < L(detail::largest));
  detail::Pair<L> const value = detail::log_of(select(usual, x, L(1.0)));
  L const odd = select(x == L(0.0), L(-detail::largest), // NaN below zero
                       select(x < L(0.0), L(std::numeric_limits<double>::quiet_NaN()), x));
  return select(usual, value.high + value.low, odd);
}

template <class L>
L log10(L const& x) {
  auto const usual = both(L(0.0) < x, x < L(detail::largest));
  detail::Pair<L> const value = detail::log_of(select(usual, x, L(1.0)));
  L const scale(0x1.bcb7b1526e50ep-2), scale_low(0x1.95355baaafad3p-57); // 1 / log 10
  L const product = value.high * scale;
  L const low =
      product_error(value.high, scale, product) + (value.high * scale_low + value.low * scale);
  return select(usual, product + low, log(x));
}

/// x to the power of y.
template <class L>
L pow(L const& x, L const& y) {
  L const zero(0.0), one(1.0), inf(detail::largest);
  L const size = abs(x);
  auto const usual = both(both(zero < size, size < inf), abs(y) < inf);
  detail::Pair<L> const log_x = detail::log_of(select(usual, size, one));
  // |log x| is 0 or above 2^-54: a larger exponent gives the same 0 or infinity.
  L const far(0x1p64);
  L const e = select(usual, select(far < y, far, select(y < -far, -far, y)), one);
  L const product = e * log_x.high;
  L const low = product_error(e, log_x.high, product) + e * log_x.low;
  L const clamped =
      select(L(1000.0) < product, L(1000.0), select(product < L(-1000.0), L(-1000.0), product));
  L value = detail::exp_of(clamped, select(clamped == product, low, zero));
  value = select(usual, value,
                 // 0 or infinity to a finite power, anything to an infinite one
                 select(abs(y) < inf,
                        select(both(size == zero, y < zero), inf,
                               select(both(size == inf, zero < y), inf, zero)),
                        select(size == one, one,
                               select(both(one < size, zero < y), inf,
                                      select(both(size < one, y < zero), inf, zero)))));
  // Below zero: only whole powers.
  L const steps = abs(y), half = L(0.5) * steps;
  auto const is_whole = detail::rounded(steps) == steps;
  auto const odd = both(both(is_whole, steps < L(0x1p53)), negate(detail::rounded(half) == half));
  value = select(odd, with_sign(value, x), value);
  auto const wrong = both(both(x < zero, size < inf), both(negate(is_whole), steps < inf));
  value = select(both(wrong, zero < size), L(std::numeric_limits<double>::quiet_NaN()), value);
  auto const nan = either(detail::is_nan(x), detail::is_nan(y));
  value = select(nan, x + y, value);
  return select(either(y == zero, x == one), one, value);
}

template <class L>
L sin(L const& x) {
  auto const finite = abs(x) < L(detail::largest);
  auto const r = detail::reduce(select(finite, x, L(0.0)));
  auto const at = detail::sin_cos_of(r.high, r.low);
  auto const odd = either(r.quadrant == L(1.0), r.quadrant == L(3.0));
  L const value = select(odd, at.cos, at.sin);
  L const signed_value = select(L(1.5) < r.quadrant, -value, value);
  return select(finite, select(x == L(0.0), x, signed_value), x - x);
}

template <class L>
L cos(L const& x) {
  auto const finite = abs(x) < L(detail::largest);
  auto const r = detail::reduce(select(finite, x, L(0.0)));
  auto const at = detail::sin_cos_of(r.high, r.low);
  auto const odd = either(r.quadrant == L(1.0), r.quadrant == L(3.0));
  L const value = select(odd, at.sin, at.cos);
  auto const minus = either(r.quadrant == L(1.0), r.quadrant == L(2.0));
  return select(finite, select(minus, -value, value), x - x);
}

template <class L>
L tan(L const& x) {
  auto const finite = abs(x) < L(detail::largest);
  auto const r = detail::reduce(select(finite, x, L(0.0)));
  auto const at = detail::sin_cos_of(r.high, r.low);
  auto const odd = either(r.quadrant == L(1.0), r.quadrant == L(3.0));
  L const value = select(odd, -at.cos / at.sin, at.sin / at.cos);
  return select(finite, select(x == L(0.0), x, value), x - x);
}

/// The angle of the point (x, y), in [-pi, pi].
template <class L>
L atan2(L const& y, L const& x) {
  L const zero(0.0), inf(detail::largest);
  // Infinite sides count as far, finite ones beside them as zero.
  L const ax = abs(x), ay = abs(y);
  auto const far_x = ax == inf, far_y = ay == inf;
  auto const far = either(far_x, far_y);
  L const a = select(far, select(far_x, L(1.0), zero), ax),
          b = select(far, select(far_y, L(1.0), zero), ay);
  // Neither of them may leave the range when they are added.
  auto const huge = either(L(0x1p1022) < a, L(0x1p1022) < b);
  L const scale = select(huge, L(0.25), L(1.0));
  auto const origin = both(a == zero, b == zero);
  L const angle =
      select(origin, zero, detail::angle_of(b * scale, select(origin, L(1.0), a * scale)));
  L const behind = L(0x1.921fb54442d18p+1) - (angle - L(0x1.1a62633145c07p-53));
  auto const is_behind = both(with_sign(L(1.0), x) < zero, either(origin, zero < a));
  L const turned = select(is_behind, behind, angle);
  L const value = with_sign(turned, y);
  return select(either(detail::is_nan(x), detail::is_nan(y)), x + y, value);
}

template <class L>
L atan(L const& x) {
  return atan2(x, L(1.0));
}

template <class L>
L asin(L const& x) {
  L const root = sqrt((L(1.0) - x) * (L(1.0) + x)); // NaN beyond 1
  return select(detail::is_nan(root), root, atan2(x, root));
}

template <class L>
L acos(L const& x) {
  L const low = sqrt(L(1.0) - x), high = sqrt(L(1.0) + x);
  return select(either(detail::is_nan(low), detail::is_nan(high)), low + high,
                L(2.0) * atan2(low, high));
}

// ------------------------------------------------------------------- of one number, within 4 ulp

double cbrt(double x);
double sinh(double x);
double cosh(double x);
double tanh(double x);
double asinh(double x);
double acosh(double x);
double atanh(double x);
/// exp(x) - 1, to the digits of a small x.
double expm1(double x);
/// sqrt(x^2 + y^2) without leaving the range of doubles on the way.
double hypot(double x, double y);

} // namespace abbe::simd
