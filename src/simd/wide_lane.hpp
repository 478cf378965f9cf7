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
#define ABBE_IN_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl"))) inline
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi" // passed by value only where it is inlined

namespace abbe::simd {

struct WideMask4;
struct Wide4 {
  using Register = double __attribute__((vector_size(32)));
  Register v;
  Wide4() = default;
  Wide4(double all) : v{all, all, all, all} {}
  explicit Wide4(Register const& r) : v(r) {}
  Wide4(double a, double b, double c, double d) : v{a, b, c, d} {}
  friend Wide4 operator+(Wide4 const& a, Wide4 const& b) { return Wide4(a.v + b.v); }
  friend Wide4 operator-(Wide4 const& a, Wide4 const& b) { return Wide4(a.v - b.v); }
  friend Wide4 operator*(Wide4 const& a, Wide4 const& b) { return Wide4(a.v * b.v); }
  friend Wide4 operator/(Wide4 const& a, Wide4 const& b) { return Wide4(a.v / b.v); }
  friend Wide4 operator-(Wide4 const& a) { return Wide4(-a.v); }
};
struct WideMask4 {
  using Register = decltype(Wide4::Register{} < Wide4::Register{});
  Register v;
};
inline WideMask4 operator<(Wide4 const& a, Wide4 const& b) {
  return {a.v < b.v};
}
inline WideMask4 operator<=(Wide4 const& a, Wide4 const& b) {
  return {a.v <= b.v};
}
inline WideMask4 operator==(Wide4 const& a, Wide4 const& b) {
  return {a.v == b.v};
}
inline WideMask4 operator>(Wide4 const& a, Wide4 const& b) {
  return b < a;
}
inline WideMask4 operator>=(Wide4 const& a, Wide4 const& b) {
  return b <= a;
}
inline WideMask4 both(WideMask4 const& a, WideMask4 const& b) {
  return {a.v & b.v};
}
inline WideMask4 either(WideMask4 const& a, WideMask4 const& b) {
  return {a.v | b.v};
}
inline WideMask4 negate(WideMask4 const& a) {
  return {~a.v};
}
inline WideMask4 operator&(WideMask4 const& a, WideMask4 const& b) {
  return both(a, b);
}
inline WideMask4 operator|(WideMask4 const& a, WideMask4 const& b) {
  return either(a, b);
}
inline WideMask4 operator!(WideMask4 const& a) {
  return negate(a);
}
__attribute__((target("avx2"))) inline bool none(WideMask4 const& a) {
  return _mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(a.v))) == 0;
}
inline Wide4 select(WideMask4 const& mask, Wide4 const& a, Wide4 const& b) {
  return Wide4(mask.v ? a.v : b.v);
}
__attribute__((target("avx2"))) inline Wide4 sqrt(Wide4 const& a) {
  return Wide4(_mm256_sqrt_pd(a.v));
}
template <>
__attribute__((target("avx2"))) inline Wide4 load<Wide4>(double const* from) {
  return Wide4(_mm256_loadu_pd(from));
}
__attribute__((target("avx2"))) inline void store(double* to, Wide4 const& a) {
  _mm256_storeu_pd(to, a.v);
}
__attribute__((target("avx2"))) inline Wide4 abs(Wide4 const& a) {
  return Wide4(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v));
}
inline double get(Wide4 const& a, int i) {
  return a.v[i];
}

struct WideMask8;
struct Wide8 {
  using Register = double __attribute__((vector_size(64)));
  Register v;
  Wide8() = default;
  Wide8(double all) : v{all, all, all, all, all, all, all, all} {}
  explicit Wide8(Register const& r) : v(r) {}
  friend Wide8 operator+(Wide8 const& a, Wide8 const& b) { return Wide8(a.v + b.v); }
  friend Wide8 operator-(Wide8 const& a, Wide8 const& b) { return Wide8(a.v - b.v); }
  friend Wide8 operator*(Wide8 const& a, Wide8 const& b) { return Wide8(a.v * b.v); }
  friend Wide8 operator/(Wide8 const& a, Wide8 const& b) { return Wide8(a.v / b.v); }
  friend Wide8 operator-(Wide8 const& a) { return Wide8(-a.v); }
};
/// A bit a lane.
struct WideMask8 {
  std::uint8_t bits;
};
ABBE_IN_AVX512 WideMask8 operator<(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)};
}
ABBE_IN_AVX512 WideMask8 operator<=(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)};
}
ABBE_IN_AVX512 WideMask8 operator==(Wide8 const& a, Wide8 const& b) {
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)};
}
ABBE_IN_AVX512 WideMask8 operator>(Wide8 const& a, Wide8 const& b) {
  return b < a;
}
ABBE_IN_AVX512 WideMask8 operator>=(Wide8 const& a, Wide8 const& b) {
  return b <= a;
}
inline WideMask8 both(WideMask8 a, WideMask8 b) {
  return {static_cast<std::uint8_t>(a.bits & b.bits)};
}
inline WideMask8 either(WideMask8 a, WideMask8 b) {
  return {static_cast<std::uint8_t>(a.bits | b.bits)};
}
inline WideMask8 negate(WideMask8 a) {
  return {static_cast<std::uint8_t>(~a.bits)};
}
inline WideMask8 operator&(WideMask8 a, WideMask8 b) {
  return both(a, b);
}
inline WideMask8 operator|(WideMask8 a, WideMask8 b) {
  return either(a, b);
}
inline WideMask8 operator!(WideMask8 a) {
  return negate(a);
}
inline bool none(WideMask8 a) {
  return a.bits == 0;
}
ABBE_IN_AVX512 Wide8 select(WideMask8 mask, Wide8 const& a, Wide8 const& b) {
  return Wide8(_mm512_mask_blend_pd(mask.bits, b.v, a.v));
}
/// Masked, for the plain one is written with a value that is not initialised (GCC 12 warns).
ABBE_IN_AVX512 Wide8 sqrt(Wide8 const& a) {
  return Wide8(_mm512_maskz_sqrt_pd(0xff, a.v));
}
template <>
ABBE_IN_AVX512 Wide8 load<Wide8>(double const* from) {
  return Wide8(_mm512_loadu_pd(from));
}
ABBE_IN_AVX512 void store(double* to, Wide8 const& a) {
  _mm512_storeu_pd(to, a.v);
}
ABBE_IN_AVX512 Wide8 abs(Wide8 const& a) {
  return Wide8(_mm512_andnot_pd(_mm512_set1_pd(-0.0), a.v));
}
inline double get(Wide8 const& a, int i) {
  return a.v[i];
}

} // namespace abbe::simd
#pragma GCC diagnostic pop
#endif
