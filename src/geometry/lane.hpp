// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <cmath>

/// What the kernels compute with: one double, or four side by side. A kernel is written once as a
/// template over the lane type L and uses only the operators + - * / < <= and the functions below,
/// so that four lanes give the same bits as four calls with doubles. There are no branches on
/// values in a kernel but those on none(): use select().
namespace abbe::geometry::lane {

inline bool both(bool a, bool b) {
  return a && b;
}
inline bool either(bool a, bool b) {
  return a || b;
}
inline bool negate(bool a) {
  return !a;
}
/// Is the mask false in every lane? The one thing to branch on: to leave out what no lane selects.
inline bool none(bool a) {
  return !a;
}
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline double abs(double a) {
  return std::fabs(a);
}
inline double get(double a, int) {
  return a;
}

/// Four doubles in two SSE2 registers (the part of x86-64 that every machine has).
struct Mask4;
struct Double4 {
  using Half = double __attribute__((vector_size(16)));
  Half low, high;

  Double4() = default;
  Double4(double all) : low{all, all}, high{all, all} {}
  Double4(Half a, Half b) : low(a), high(b) {}
  Double4(double a, double b, double c, double d) : low{a, b}, high{c, d} {}
  friend Double4 operator+(Double4 const& a, Double4 const& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Double4 operator-(Double4 const& a, Double4 const& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend Double4 operator*(Double4 const& a, Double4 const& b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend Double4 operator/(Double4 const& a, Double4 const& b) {
    return {a.low / b.low, a.high / b.high};
  }
  friend Double4 operator-(Double4 const& a) { return {-a.low, -a.high}; }
};
struct Mask4 {
  using Half = decltype(Double4::Half{} < Double4::Half{});
  Half low, high;
};
inline Mask4 operator<(Double4 const& a, Double4 const& b) {
  return {a.low < b.low, a.high < b.high};
}
inline Mask4 operator<=(Double4 const& a, Double4 const& b) {
  return {a.low <= b.low, a.high <= b.high};
}
inline Mask4 operator==(Double4 const& a, Double4 const& b) {
  return {a.low == b.low, a.high == b.high};
}
inline Mask4 both(Mask4 const& a, Mask4 const& b) {
  return {a.low & b.low, a.high & b.high};
}
inline Mask4 either(Mask4 const& a, Mask4 const& b) {
  return {a.low | b.low, a.high | b.high};
}
inline Mask4 negate(Mask4 const& a) {
  return {~a.low, ~a.high};
}
inline bool none(Mask4 const& a) {
  auto const both_halves = a.low | a.high;
  return (both_halves[0] | both_halves[1]) == 0;
}
inline Double4 select(Mask4 const& mask, Double4 const& a, Double4 const& b) {
  return {mask.low ? a.low : b.low, mask.high ? a.high : b.high};
}
inline Double4 sqrt(Double4 const& a) {
  return {std::sqrt(a.low[0]), std::sqrt(a.low[1]), std::sqrt(a.high[0]), std::sqrt(a.high[1])};
}
inline Double4 abs(Double4 const& a) {
  return select(a < Double4(0.0), -a, a + 0.0);
}
inline double get(Double4 const& a, int i) {
  return i < 2 ? a.low[i] : a.high[i - 2];
}

template <class L>
L min(L const& a, L const& b) {
  return select(b < a, b, a);
}
template <class L>
L max(L const& a, L const& b) {
  return select(a < b, b, a);
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
  return {lane::abs(a.x), lane::abs(a.y), lane::abs(a.z)};
}
template <class L>
L dot(Vec<L> const& a, Vec<L> const& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class L>
L sum(Vec<L> const& a) {
  return a.x + a.y + a.z;
}

} // namespace abbe::geometry::lane
