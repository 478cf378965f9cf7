// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// The lane types of the kernels (lane.hpp): one double, and four side by side. A kernel is written
/// once as a template over the lane type L and uses only the operators + - * / < <= and the
/// functions below, so that four lanes give the same bits as four calls with doubles. There are no
/// branches on values in a kernel but those on none(): use select().
namespace abbe::simd {

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

/// 2^k, of k + 1.5 2^52 with k a whole number in [-1022, 1023].
inline double power_of_two(double shifted) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
}
/// The exponent of a positive normal number: it is significand(x) 2^exponent(x).
inline double exponent(double x) {
  auto const biased = std::bit_cast<std::uint64_t>(x) >> 52;
  return std::bit_cast<double>(biased | 0x4330000000000000) - (0x1p52 + 1023);
}
/// In [1, 2).
inline double significand(double x) {
  auto const fraction = std::bit_cast<std::uint64_t>(x) & 0x000fffffffffffff;
  return std::bit_cast<double>(fraction | 0x3ff0000000000000);
}

/// A number that is not below zero, with the sign of another, be that a zero.
inline double with_sign(double magnitude, double sign) {
  return std::copysign(magnitude, sign);
}

/// Four doubles in two SSE2 registers (the part of x86-64 that every machine has).
struct Mask4;
struct Double4 {
  using Half = double __attribute__((vector_size(16)));
  using Integers = std::uint64_t __attribute__((vector_size(16)));
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
inline Mask4 operator>(Double4 const& a, Double4 const& b) {
  return b < a;
}
inline Mask4 operator>=(Double4 const& a, Double4 const& b) {
  return b <= a;
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
inline Mask4 operator&(Mask4 const& a, Mask4 const& b) {
  return both(a, b);
}
inline Mask4 operator|(Mask4 const& a, Mask4 const& b) {
  return either(a, b);
}
inline Mask4 operator!(Mask4 const& a) {
  return negate(a);
}
inline bool none(Mask4 const& a) {
  auto const both_halves = a.low | a.high;
#if defined(__SSE2__)
  return _mm_movemask_pd(reinterpret_cast<__m128d>(both_halves)) == 0;
#else
  return (both_halves[0] | both_halves[1]) == 0;
#endif
}
inline Double4 select(Mask4 const& mask, Double4 const& a, Double4 const& b) {
  return {mask.low ? a.low : b.low, mask.high ? a.high : b.high};
}
inline Double4 sqrt(Double4 const& a) {
#if defined(__SSE2__)
  return {_mm_sqrt_pd(a.low), _mm_sqrt_pd(a.high)};
#else
  return {std::sqrt(a.low[0]), std::sqrt(a.low[1]), std::sqrt(a.high[0]), std::sqrt(a.high[1])};
#endif
}
inline Double4 power_of_two(Double4 const& shifted) {
  auto const half = [](Double4::Half const& x) {
    return reinterpret_cast<Double4::Half>((reinterpret_cast<Double4::Integers>(x) + 1023) << 52);
  };
  return {half(shifted.low), half(shifted.high)};
}
inline Double4 exponent(Double4 const& of) {
  auto const half = [](Double4::Half const& x) {
    auto const biased = (reinterpret_cast<Double4::Integers>(x) >> 52) | 0x4330000000000000;
    return reinterpret_cast<Double4::Half>(biased) - (0x1p52 + 1023);
  };
  return {half(of.low), half(of.high)};
}
inline Double4 significand(Double4 const& of) {
  auto const half = [](Double4::Half const& x) {
    auto const fraction = reinterpret_cast<Double4::Integers>(x) & 0x000fffffffffffff;
    return reinterpret_cast<Double4::Half>(fraction | 0x3ff0000000000000);
  };
  return {half(of.low), half(of.high)};
}
inline Double4 with_sign(Double4 const& magnitude, Double4 const& sign) {
  auto const half = [](Double4::Half const& x, Double4::Half const& y) {
    return reinterpret_cast<Double4::Half>(
        reinterpret_cast<Double4::Integers>(x)
        | (reinterpret_cast<Double4::Integers>(y) & 0x8000000000000000));
  };
  return {half(magnitude.low, sign.low), half(magnitude.high, sign.high)};
}
/// From and to memory, in order.
template <class L>
L load(double const* from);
template <>
inline double load<double>(double const* from) {
  return *from;
}
template <>
inline Double4 load<Double4>(double const* from) {
#if defined(__SSE2__)
  return {_mm_loadu_pd(from), _mm_loadu_pd(from + 2)};
#else
  return {from[0], from[1], from[2], from[3]};
#endif
}
inline void store(double* to, double a) {
  *to = a;
}
inline void store(double* to, Double4 const& a) {
#if defined(__SSE2__)
  _mm_storeu_pd(to, a.low);
  _mm_storeu_pd(to + 2, a.high);
#else
  to[0] = a.low[0];
  to[1] = a.low[1];
  to[2] = a.high[0];
  to[3] = a.high[1];
#endif
}
inline Double4 abs(Double4 const& a) {
#if defined(__SSE2__)
  __m128d const sign = _mm_set1_pd(-0.0);
  return {_mm_andnot_pd(sign, a.low), _mm_andnot_pd(sign, a.high)};
#else
  return select(a < Double4(0.0), -a, a + 0.0);
#endif
}
inline double get(Double4 const& a, int i) {
  return i < 2 ? a.low[i] : a.high[i - 2];
}

} // namespace abbe::simd
