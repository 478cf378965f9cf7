// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane.hpp"

#include <algorithm>
#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// Eight floats side by side, for what only has to be told apart: bounds, never results. The words
/// are those of lane_types.hpp.
namespace abbe::simd {

/// In two SSE registers.
struct Float8 {
  using Half = float __attribute__((vector_size(16)));
  using MaskHalf = decltype(Half{} < Half{});
  Half low, high;
  struct Mask {
    MaskHalf low, high;
  };
  Float8(float all) : low{all, all, all, all}, high{all, all, all, all} {}
  Float8(Half const& a, Half const& b) : low(a), high(b) {}
  static Float8 load(float const* from) {
    Half a, b;
    std::memcpy(&a, from, sizeof a);
    std::memcpy(&b, from + 4, sizeof b);
    return {a, b};
  }
  void store(float* to) const {
    std::memcpy(to, &low, sizeof low);
    std::memcpy(to + 4, &high, sizeof high);
  }
  friend Float8 operator+(Float8 const& a, Float8 const& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Float8 operator-(Float8 const& a, Float8 const& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend Float8 operator*(Float8 const& a, Float8 const& b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend Float8 operator/(Float8 const& a, Float8 const& b) {
    return {a.low / b.low, a.high / b.high};
  }
  friend Mask operator<(Float8 const& a, Float8 const& b) {
    return {a.low < b.low, a.high < b.high};
  }
  friend Mask both(Mask const& a, Mask const& b) { return {a.low & b.low, a.high & b.high}; }
  friend Float8 select(Mask const& mask, Float8 const& a, Float8 const& b) {
    return {mask.low ? a.low : b.low, mask.high ? a.high : b.high};
  }
  /// Is the mask true in every lane?
  friend bool every(Mask const& a) {
    auto const of_both = a.low & a.high;
    return (of_both[0] & of_both[1] & of_both[2] & of_both[3]) != 0;
  }
  /// A bit a lane.
  friend unsigned bits(Mask const& a) {
#if defined(__SSE2__)
    auto const half = [](MaskHalf const& m) {
      return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m)));
    };
    return half(a.low) | half(a.high) << 4;
#else
    unsigned out = 0;
    for (int i = 0; i < 4; ++i)
      out |= (a.low[i] != 0 ? 1U : 0U) << i | (a.high[i] != 0 ? 1U : 0U) << (i + 4);
    return out;
#endif
  }
  /// The second where one is not a number.
  friend Float8 least(Float8 const& a, Float8 const& b) {
    return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
  }
  friend Float8 most(Float8 const& a, Float8 const& b) {
    return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
  }
};

#if ABBE_HAS_WIDE_LANES
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi" // passed by value only where it is inlined
/// In one register of AVX2.
struct WideFloat8 {
  using Register = float __attribute__((vector_size(32)));
  Register v;
  struct Mask {
    decltype(Register{} < Register{}) v;
  };
  __attribute__((target("avx2"))) WideFloat8(float all) : v(_mm256_set1_ps(all)) {}
  explicit WideFloat8(Register const& r) : v(r) {}
  __attribute__((target("avx2"))) static WideFloat8 load(float const* from) {
    return WideFloat8(_mm256_loadu_ps(from));
  }
  __attribute__((target("avx2"))) void store(float* to) const { _mm256_storeu_ps(to, v); }
  friend WideFloat8 operator+(WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(a.v + b.v);
  }
  friend WideFloat8 operator-(WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(a.v - b.v);
  }
  friend WideFloat8 operator*(WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(a.v * b.v);
  }
  friend WideFloat8 operator/(WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(a.v / b.v);
  }
  friend Mask operator<(WideFloat8 const& a, WideFloat8 const& b) { return {a.v < b.v}; }
  friend Mask both(Mask const& a, Mask const& b) { return {a.v & b.v}; }
  friend WideFloat8 select(Mask const& mask, WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(mask.v ? a.v : b.v);
  }
  __attribute__((target("avx2"))) friend bool every(Mask const& a) { return bits(a) == 0xff; }
  __attribute__((target("avx2"))) friend unsigned bits(Mask const& a) {
    return static_cast<unsigned>(
        _mm256_movemask_ps(_mm256_castsi256_ps(reinterpret_cast<__m256i>(a.v))));
  }
  __attribute__((target("avx2"))) friend WideFloat8 least(WideFloat8 const& a,
                                                          WideFloat8 const& b) {
    return WideFloat8(_mm256_min_ps(a.v, b.v));
  }
  __attribute__((target("avx2"))) friend WideFloat8 most(WideFloat8 const& a, WideFloat8 const& b) {
    return WideFloat8(_mm256_max_ps(a.v, b.v));
  }
};
#pragma GCC diagnostic pop
#endif

/// Floats that go with doubles of type L.
template <class L>
struct FloatsOf {
  using Type = Float8;
};
#if ABBE_HAS_WIDE_LANES
template <>
struct FloatsOf<Wide4> {
  using Type = WideFloat8;
};
template <>
struct FloatsOf<Wide8> {
  using Type = WideFloat8;
};
#endif

} // namespace abbe::simd
