// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/lane_types.hpp"

/// Four doubles in one register, for code that is compiled for AVX2 (ABBE_FOR_AVX2) and chosen at
/// run time. The same operations as lane::Double4, so the same bits. (Not with clang, which refuses
/// such registers in code that is not all for AVX2.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#include <immintrin.h>
#define ABBE_HAS_WIDE_LANES 1
/// Everything that the function calls and whose body is known becomes part of it, for the wider
/// registers, too.
#define ABBE_FOR_AVX2 __attribute__((target("avx2"), flatten))
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi" // passed by value only where it is inlined

namespace abbe::geometry::lane {

struct WideMask4;
struct Wide4 {
  using Register = double __attribute__((vector_size(32)));
  Register v;
  Wide4() = default;
  Wide4(double all) : v{all, all, all, all} {}
  explicit Wide4(Register r) : v(r) {}
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
/// The words of optics/lane.hpp for the same.
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

} // namespace abbe::geometry::lane
#pragma GCC diagnostic pop
#endif
