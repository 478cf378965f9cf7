// SPDX-License-Identifier: MIT
#pragma once

#include "base/interval.hpp"

#include <cstddef>

namespace abbe::lang {

/// Enclosures of a value and of its derivative by the parameter of a line.
struct Dual {
  Interval v, d;
};

inline Dual operator-(Dual const& a) {
  return {-a.v, -a.d};
}
inline Dual operator+(Dual const& a, Dual const& b) {
  return {a.v + b.v, a.d + b.d};
}
inline Dual operator-(Dual const& a, Dual const& b) {
  return {a.v - b.v, a.d - b.d};
}
inline Dual operator*(Dual const& a, Dual const& b) {
  return {a.v * b.v, a.d * b.v + a.v * b.d};
}
inline Dual operator/(Dual const& a, Dual const& b) {
  return {a.v / b.v, (a.d * b.v - a.v * b.d) / square(b.v)};
}
inline Dual square(Dual const& a) {
  return {square(a.v), Interval(2) * a.v * a.d};
}
/// Either of them, whichever it is at each point; continuous where they meet.
inline Dual hull(Dual const& a, Dual const& b) {
  return {hull(a.v, b.v), hull(a.d, b.d)};
}

/// The library function of that place in float_functions(), on enclosures.
Dual apply(std::size_t function, Dual const& a, Dual const& b);

} // namespace abbe::lang
