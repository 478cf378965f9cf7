// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe {

/// All numbers from low to high (either may be infinite). Arithmetic rounds outward: the result
/// holds every result of numbers of the operands. What is undefined somewhere is everything.
struct Interval {
  double low = 0, high = 0;

  constexpr Interval() = default;
  constexpr Interval(double x) : low(x), high(x) {}
  constexpr Interval(double a, double b) : low(a), high(b) {}
  static constexpr Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool holds(double x) const { return low <= x && x <= high; }
  double width() const { return high - low; }
  double middle() const { return 0.5 * low + 0.5 * high; }
  /// Largest absolute value.
  double size() const { return std::max(std::fabs(low), std::fabs(high)); }
};

/// [low, high] wider by `roundings` units in the last place on both sides; everything when either
/// is undefined.
inline Interval widened(double low, double high, int roundings = 1) {
  if (!(low <= high)) return Interval::everything();
  double const share = 0x1p-52 * roundings, least = std::numeric_limits<double>::denorm_min();
  return {low - (std::fabs(low) * share + least), high + (std::fabs(high) * share + least)};
}

inline Interval operator-(Interval const& a) {
  return {-a.high, -a.low};
}
inline Interval operator+(Interval const& a, Interval const& b) {
  return widened(a.low + b.low, a.high + b.high);
}
inline Interval operator-(Interval const& a, Interval const& b) {
  return widened(a.low - b.high, a.high - b.low);
}
inline Interval operator*(Interval const& a, Interval const& b) {
  // Zero times infinity: a bound that is not reached times zero.
  auto const product = [](double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; };
  double const p = product(a.low, b.low), q = product(a.low, b.high), r = product(a.high, b.low),
               s = product(a.high, b.high);
  return widened(std::min(std::min(p, q), std::min(r, s)),
                 std::max(std::max(p, q), std::max(r, s)));
}
inline Interval operator/(Interval const& a, Interval const& b) {
  if (b.low <= 0 && b.high >= 0) return Interval::everything();
  return a * widened(1 / b.high, 1 / b.low);
}
/// The smallest interval that holds both.
inline Interval hull(Interval const& a, Interval const& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
inline Interval abs(Interval const& a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}
inline Interval square(Interval const& a) {
  Interval const size = abs(a);
  Interval const result = widened(size.low * size.low, size.high * size.high);
  return {std::max(0.0, result.low), result.high};
}

} // namespace abbe
