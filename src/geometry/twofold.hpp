// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "simd/lane.hpp"

/// Numbers of twice the digits, for what doubles cannot tell.
namespace abbe::geometry {

/// high + low, |low| at most half a unit in the last place of high. Each operation is off by at
/// most 2^-102 of its result, of a sum by at most 2^-102 of the sum of the absolute values.
/// @source Dekker 1971; Joldes, Muller, Popescu 2017 (sloppy sum, product without fma)
struct Twofold {
  double high = 0, low = 0;

  Twofold() = default;
  Twofold(double x) : high(x) {}
  Twofold(double a, double b) : high(a + b), low(b - (high - a)) {} ///< |a| >= |b| or a == 0
};

inline Twofold two_sum(double a, double b) {
  double const sum = a + b, part = sum - a;
  Twofold result;
  result.high = sum;
  result.low = (a - (sum - part)) + (b - part);
  return result;
}
inline Twofold operator-(Twofold const& a) {
  Twofold result;
  result.high = -a.high;
  result.low = -a.low;
  return result;
}
inline Twofold operator+(Twofold const& a, Twofold const& b) {
  Twofold const sum = two_sum(a.high, b.high);
  return {sum.high, sum.low + (a.low + b.low)};
}
inline Twofold operator-(Twofold const& a, Twofold const& b) {
  return a + -b;
}
inline Twofold operator*(Twofold const& a, Twofold const& b) {
  double const product = a.high * b.high;
  return {product,
          lane::product_error(a.high, b.high, product) + (a.high * b.low + a.low * b.high)};
}

/// What templates over double and Twofold ask.
inline double rounded(double x) {
  return x;
}
inline double rounded(Twofold const& x) {
  return x.high;
}
/// Of one operation.
template <class N>
inline constexpr double roundoff = unit_roundoff;
template <>
inline constexpr double roundoff<Twofold> = 0x1p-102;

} // namespace abbe::geometry
