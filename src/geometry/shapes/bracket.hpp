// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace abbe::geometry {

/// The root of a function in [low, high] where its values have different signs, as far as doubles
/// can tell: Newton's method, with bisection where that leaves the bracket or converges slowly.
/// @param f x -> {value, derivative} (a pair)
template <class F>
double bracketed_root(F const& f, double low, double high, bool low_negative) {
  double x = 0.5 * (low + high), last_step = high - low;
  for (int i = 0; i < 200; ++i) {
    auto const [value, derivative] = f(x);
    if (value == 0) return x;
    ((value < 0) == low_negative ? low : high) = x;
    double const newton = x - value / derivative;
    bool const good = newton > low && newton < high && std::fabs(newton - x) < 0.5 * last_step;
    double const next = good ? newton : 0.5 * (low + high);
    last_step = std::fabs(next - x);
    if (next == x || next <= low || next >= high) return next;
    x = next;
  }
  return x;
}

} // namespace abbe::geometry
