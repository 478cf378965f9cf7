// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane_types.hpp"

/// Four and eight doubles in one register, for code that is compiled for AVX2 or AVX-512
/// (simd/native.hpp) and chosen at run time. The same operations as simd::Double4,
/// so the same bits. (Not with clang, which refuses such registers in code that is not all for
/// them.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <cstdint>
#include <immintrin.h>
#define ABBE_HAS_WIDE_LANES 1
/// Everything that the function calls and whose body is known becomes part of it, for the wider
/// registers, too.
#define ABBE_FOR_AVX2 __attribute__((target("avx2"), flatten))
#define ABBE_FOR_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl"), flatten))
/// Of what becomes part of such functions. Without it the compiler takes the registers for ones
/// that it does not have, and puts a constant together lane by lane.
#define ABBE_IN_AVX2 __attribute__((target("avx2")))
#define ABBE_IN_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi" // passed by value only where it is inlined

namespace abbe::simd {

struct WideMask4;
/// Copies are written out: the compiler's own go through the registers of integers, piece by piece.
struct Wide4 {
  using Register = double __attribute__((vector_size(32)));
  using Integers = std::uint64_t __attribute__((vector_size(32)));
  Register v;
  Wide4() = default;
  ABBE_IN_AVX2 Wide4(Wide4 const& from) : v(from.v) {}
  ABBE_IN_AVX2 Wide4& operator=(Wide4 const& from) {
    v = from.v;
    return *this;
  }
  ABBE_IN_AVX2 Wide4(double all) : v(all - Register{}) {}
  ABBE_IN_AVX2 explicit Wide4(Register const& r) : v(r) {}
  ABBE_IN_AVX2 Wide4(double a, double b, double c, double d) : v{a, b, c, d} {}
  ABBE_IN_AVX2 friend Wide4 operator+(Wide4 const& a, Wide4 const& b) { return Wide4(a.v + b.v); }
  ABBE_IN_AVX2 friend Wide4 operator-(Wide4 const& a, Wide4 const& b) { return Wide4(a.v - b.v); }
  ABBE_IN_AVX2 friend Wide4 operator*(Wide4 const& a, Wide4 const& b) { return Wide4(a.v * b.v); }
  ABBE_IN_AVX2 friend Wide4 operator/(Wide4 const& a, Wide4 const& b) { return Wide4(a.v / b.v); }
  ABBE_IN_AVX2 friend Wide4 operator-(Wide4 const& a) { return Wide4(-a.v); }
};
struct WideMask4 {
  using Register = decltype(Wide4::Register{} < Wide4::Register{});
  Register v;
  WideMask4() = default;
  ABBE_IN_AVX2 WideMask4(Register const& mask) : v(mask) {}
  ABBE_IN_AVX2 WideMask4(WideMask4 const& from) : v(from.v) {}
  ABBE_IN_AVX2 WideMask4& operator=(WideMask4 const& from) {
    v = from.v;
    return *this;
  }
};
ABBE_IN_AVX2 inline WideMask4 operator<(Wide4 const& a, Wide4 const& b) {
  return {a.v < b.v};
}
ABBE_IN_AVX2 inline WideMask4 operator<=(Wide4 const& a, Wide4 const& b) {
  return {a.v <= b.v};
}
ABBE_IN_AVX2 inline WideMask4 operator==(Wide4 const& a, Wide4 const& b) {
  return {a.v == b.v};
}
ABBE_IN_AVX2 inline WideMask4 operator>(Wide4 const& a, Wide4 const& b) {
  return b < a;
}
ABBE_IN_AVX2 inline WideMask4 operator>=(Wide4 const& a, Wide4 const& b) {
  return b <= a;
}
ABBE_IN_AVX2 inline WideMask4 both(WideMask4 const& a, WideMask4 const& b) {
  return {a.v & b.v};
}
ABBE_IN_AVX2 inline WideMask4 either(WideMask4 const& a, WideMask4 const& b) {
  return {a.v | b.v};
}
ABBE_IN_AVX2 inline WideMask4 negate(WideMask4 const& a) {
  return {~a.v};
}
ABBE_IN_AVX2 inline WideMask4 operator&(WideMask4 const& a, WideMask4 const& b) {
  return both(a, b);
}
ABBE_IN_AVX2 inline WideMask4 operator|(WideMask4 const& a, WideMask4 const& b) {
  return either(a, b);
}
ABBE_IN_AVX2 inline WideMask4 operator!(WideMask4 const& a) {
  return negate(a);
}
ABBE_IN_AVX2 inline bool none(WideMask4 const& a) {
  return _mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(a.v))) == 0;
}
ABBE_IN_AVX2 inline Wide4 select(WideMask4 const& mask, Wide4 const& a, Wide4 const& b) {
  return Wide4(mask.v ? a.v : b.v);
}
ABBE_IN_AVX2 inline Wide4 sqrt(Wide4 const& a) {
  return Wide4(_mm256_sqrt_pd(a.v));
}
template <>
ABBE_IN_AVX2 inline Wide4 load<Wide4>(double const* from) {
  return Wide4(_mm256_loadu_pd(from));
}
ABBE_IN_AVX2 inline void store(double* to, Wide4 const& a) {
  _mm256_storeu_pd(to, a.v);
}
ABBE_IN_AVX2 inline Wide4 abs(Wide4 const& a) {
  return Wide4(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v));
}
ABBE_IN_AVX2 inline Wide4 power_of_two(Wide4 const& shifted) {
  return Wide4(reinterpret_cast<Wide4::Register>(
      (reinterpret_cast<Wide4::Integers>(shifted.v) + 1023) << 52));
}
ABBE_IN_AVX2 inline Wide4 exponent(Wide4 const& x) {
  auto const biased = (reinterpret_cast<Wide4::Integers>(x.v) >> 52) | 0x4330000000000000;
  return Wide4(reinterpret_cast<Wide4::Register>(biased) - (0x1p52 + 1023));
}
ABBE_IN_AVX2 inline Wide4 significand(Wide4 const& x) {
  auto const fraction = reinterpret_cast<Wide4::Integers>(x.v) & 0x000fffffffffffff;
  return Wide4(reinterpret_cast<Wide4::Register>(fraction | 0x3ff0000000000000));
}
ABBE_IN_AVX2 inline Wide4 with_sign(Wide4 const& magnitude, Wide4 const& sign) {
  auto const minus = reinterpret_cast<Wide4::Integers>(sign.v) & 0x8000000000000000;
  return Wide4(
      reinterpret_cast<Wide4::Register>(reinterpret_cast<Wide4::Integers>(magnitude.v) | minus));
}
ABBE_IN_AVX2 inline double get(Wide4 const& a, int i) {
  return a.v[i];
}

struct WideMask8;
struct Wide8 {
  using Register = double __attribute__((vector_size(64)));
  using Integers = std::uint64_t __attribute__((vector_size(64)));
  Register v;
  Wide8() = default;
  ABBE_IN_AVX512 Wide8(Wide8 const& from) : v(from.v) {}
  ABBE_IN_AVX512 Wide8& operator=(Wide8 const& from) {
    v = from.v;
    return *this;
  }
  ABBE_IN_AVX512 Wide8(double all) : v(all - Register{}) {}
  ABBE_IN_AVX512 explicit Wide8(Register const& r) : v(r) {}
  ABBE_IN_AVX512 friend Wide8 operator+(Wide8 const& a, Wide8 const& b) { return Wide8(a.v + b.v); }
  ABBE_IN_AVX512 friend Wide8 operator-(Wide8 const& a, Wide8 const& b) { return Wide8(a.v - b.v); }
  ABBE_IN_AVX512 friend Wide8 operator*(Wide8 const& a, Wide8 const& b) { return Wide8(a.v * b.v); }
  ABBE_IN_AVX512 friend Wide8 operator/(Wide8 const& a, Wide8 const& b) { return Wide8(a.v / b.v); }
  ABBE_IN_AVX512 friend Wide8 operator-(Wide8 const& a) { return Wide8(-a.v); }
};
/// A bit a lane.
struct WideMask8 {
  std::uint8_t bits;
};
ABBE_IN_AVX512 inline WideMask8 operator<(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)};
}
ABBE_IN_AVX512 inline WideMask8 operator<=(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)};
}
ABBE_IN_AVX512 inline WideMask8 operator==(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)};
}
ABBE_IN_AVX512 inline WideMask8 operator>(Wide8 const& a, Wide8 const& b) {
  return b < a;
}
ABBE_IN_AVX512 inline WideMask8 operator>=(Wide8 const& a, Wide8 const& b) {
  return b <= a;
}
ABBE_IN_AVX512 inline WideMask8 both(WideMask8 a, WideMask8 b) {
  return {static_cast<std::uint8_t>(a.bits & b.bits)};
}
ABBE_IN_AVX512 inline WideMask8 either(WideMask8 a, WideMask8 b) {
  return {static_cast<std::uint8_t>(a.bits | b.bits)};
}
ABBE_IN_AVX512 inline WideMask8 negate(WideMask8 a) {
  return {static_cast<std::uint8_t>(~a.bits)};
}
ABBE_IN_AVX512 inline WideMask8 operator&(WideMask8 a, WideMask8 b) {
  return both(a, b);
}
ABBE_IN_AVX512 inline WideMask8 operator|(WideMask8 a, WideMask8 b) {
  return either(a, b);
}
ABBE_IN_AVX512 inline WideMask8 operator!(WideMask8 a) {
  return negate(a);
}
ABBE_IN_AVX512 inline bool none(WideMask8 a) {
  return a.bits == 0;
}
ABBE_IN_AVX512 inline Wide8 select(WideMask8 mask, Wide8 const& a, Wide8 const& b) {
  return Wide8(_mm512_mask_blend_pd(mask.bits, b.v, a.v));
}
/// Masked, for the plain one is written with a value that is not initialised (GCC 12 warns).
ABBE_IN_AVX512 inline Wide8 sqrt(Wide8 const& a) {
  return Wide8(_mm512_maskz_sqrt_pd(0xff, a.v));
}
template <>
ABBE_IN_AVX512 inline Wide8 load<Wide8>(double const* from) {
  return Wide8(_mm512_loadu_pd(from));
}
ABBE_IN_AVX512 inline void store(double* to, Wide8 const& a) {
  _mm512_storeu_pd(to, a.v);
}
ABBE_IN_AVX512 inline Wide8 abs(Wide8 const& a) {
  return Wide8(_mm512_andnot_pd(_mm512_set1_pd(-0.0), a.v));
}
ABBE_IN_AVX512 inline Wide8 power_of_two(Wide8 const& shifted) {
  return Wide8(reinterpret_cast<Wide8::Register>(
      (reinterpret_cast<Wide8::Integers>(shifted.v) + 1023) << 52));
}
ABBE_IN_AVX512 inline Wide8 exponent(Wide8 const& x) {
  auto const biased = (reinterpret_cast<Wide8::Integers>(x.v) >> 52) | 0x4330000000000000;
  return Wide8(reinterpret_cast<Wide8::Register>(biased) - (0x1p52 + 1023));
}
ABBE_IN_AVX512 inline Wide8 significand(Wide8 const& x) {
  auto const fraction = reinterpret_cast<Wide8::Integers>(x.v) & 0x000fffffffffffff;
  return Wide8(reinterpret_cast<Wide8::Register>(fraction | 0x3ff0000000000000));
}
ABBE_IN_AVX512 inline Wide8 with_sign(Wide8 const& magnitude, Wide8 const& sign) {
  auto const minus = reinterpret_cast<Wide8::Integers>(sign.v) & 0x8000000000000000;
  return Wide8(
      reinterpret_cast<Wide8::Register>(reinterpret_cast<Wide8::Integers>(magnitude.v) | minus));
}
ABBE_IN_AVX512 inline double get(Wide8 const& a, int i) {
  return a.v[i];
}

} // namespace abbe::simd
#pragma GCC diagnostic pop
#endif
