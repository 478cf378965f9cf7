// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace abbe::geometry {

/// The root of a function in [low, high] where its values have different signs, as far as doubles
/// can tell: Newton's method, with bisection where that leaves the bracket or converges slowly.
/// @param f x -> {value, derivative} (a pair)
/// @param x within the bracket: where to begin
template <class F>
double bracketed_root(F const& f, double low, double high, bool low_negative, double x) {
  // So near, what is not quadratic convergence is rounding.
  double const close = 0x1p-36 * (high - low);
  double last_step = high - low;
  for (int i = 0; i < 200; ++i) {
    auto const [value, derivative] = f(x);
    if (value == 0) return x;
    ((value < 0) == low_negative ? low : high) = x;
    double const newton = x - value / derivative;
    if (newton == x) return x;
    bool const inside = newton > low && newton < high;
    bool const shorter = std::fabs(newton - x) < 0.5 * last_step;
    if (inside && !shorter && last_step <= close) return newton;
    double const next = inside && shorter ? newton : 0.5 * (low + high);
    last_step = std::fabs(next - x);
    if (next == x || next <= low || next >= high) return next;
    x = next;
  }
  return x;
}
template <class F>
double bracketed_root(F const& f, double low, double high, bool low_negative) {
  return bracketed_root(f, low, high, low_negative, 0.5 * (low + high));
}

} // namespace abbe::geometry
