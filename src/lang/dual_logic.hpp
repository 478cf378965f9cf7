// SPDX-License-Identifier: MIT
#pragma once

#include "lang/dual_interval.hpp"
#include "lang/function.hpp"

#include <algorithm>
#include <cmath>

/// Comparisons and choices of functions, carried out on enclosures.
namespace abbe::lang {

enum class Truth { No, Yes, Open };

inline Dual dual_of(Truth truth) {
  if (truth == Truth::Open) return {{0, 1}, Interval::everything()};
  return {truth == Truth::Yes ? 1.0 : 0.0, Interval(0)};
}
inline Truth truth(bool never, bool always) {
  return always ? Truth::Yes : never ? Truth::No : Truth::Open;
}
inline Truth is_set(Interval const& x) {
  return truth(x.size() == 0, x.low > 0 || x.high < 0);
}
inline Truth less(Interval const& a, Interval const& b) {
  return truth(a.low >= b.high, a.high < b.low);
}
/// a <= b
inline Truth less_equal(Interval const& a, Interval const& b) {
  return truth(a.low > b.high, a.high <= b.low);
}
inline Truth equal(Interval const& a, Interval const& b) {
  return truth(a.low > b.high || b.low > a.high, a.high <= b.low && b.high <= a.low);
}
inline Truth both(Truth a, Truth b) {
  return truth(a == Truth::No || b == Truth::No, a == Truth::Yes && b == Truth::Yes);
}
inline Truth negated(Truth a) {
  return a == Truth::Open ? a : (a == Truth::Yes ? Truth::No : Truth::Yes);
}

/// @param kind And to Greater
inline Dual compared(FunctionValue::Node::Kind kind, Interval const& a, Interval const& b) {
  using Kind = FunctionValue::Node::Kind;
  switch (kind) {
  case Kind::And:
    return dual_of(both(is_set(a), is_set(b)));
  case Kind::Or:
    return dual_of(negated(both(negated(is_set(a)), negated(is_set(b)))));
  case Kind::Less:
    return dual_of(less(a, b));
  case Kind::LessEqual:
    return dual_of(less_equal(a, b));
  case Kind::Equal:
    return dual_of(equal(a, b));
  case Kind::NotEqual:
    return dual_of(negated(equal(a, b)));
  case Kind::GreaterEqual:
    return dual_of(less_equal(b, a));
  default:
    return dual_of(less(b, a));
  }
}

inline Dual lesser(Dual const& a, Dual const& b) {
  if (a.v.high < b.v.low) return a;
  if (b.v.high < a.v.low) return b;
  return {{std::min(a.v.low, b.v.low), std::min(a.v.high, b.v.high)}, hull(a.d, b.d)};
}

/// `select` of a number and two or three branches. @param branch(i) the i-th, from 1
template <class Branch>
Dual selected(Interval const& which, bool pair, Branch const& branch) {
  bool const low = which.low<0, zero = which.holds(0), high = which.high> 0;
  Dual result;
  int branches = 0;
  auto const take = [&](std::uint32_t i) {
    Dual const own = branch(i);
    result = branches++ == 0 ? own : Dual{hull(result.v, own.v), Interval::everything()};
  };
  if (low) take(1);
  if (pair ? zero || high : zero) take(2);
  if (!pair && high) take(3);
  return branches == 0 ? Dual{Interval::everything(), Interval::everything()} : result;
}

/// The value that a block yields at a point, with its rounding.
inline Interval at_point(double value) {
  double const off = 0x1p-44 * (1 + std::fabs(value));
  return {value - off, value + off};
}

} // namespace abbe::lang
