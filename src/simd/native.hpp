// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane.hpp"
#include "simd/registers.hpp"

#include <cstddef>

namespace abbe::simd {

/// A kernel, compiled for each width of registers and chosen once for the machine:
///
///     struct Absorb {
///       template <class L>
///       static void run(double const* depths, std::size_t count, double* values);
///     };
///     Native<Absorb> const absorb;
///     absorb(depths, count, values);
///
/// `run` is written once for any lane type L. Every width gives the same bits, so that the choice
/// shows in nothing but the time taken.
/// @tparam widest most lanes that `run` is made for: 4 or 8
template <class Kernel, std::size_t widest = 8,
          class Signature = decltype(Kernel::template run<Double4>)>
class Native;

template <class Kernel, std::size_t widest, class Result, class... Arguments>
class Native<Kernel, widest, Result(Arguments...)> {
public:
  constexpr Native() {} // so that a const object needs no initialiser
  Result operator()(Arguments... arguments) const { return chosen_(arguments...); }

private:
  static Result baseline(Arguments... arguments) {
    return Kernel::template run<Double4>(arguments...);
  }
#if ABBE_HAS_WIDE_LANES
  ABBE_FOR_AVX2 static Result avx2(Arguments... arguments) {
    return Kernel::template run<Wide4>(arguments...);
  }
  ABBE_FOR_AVX512 static Result avx512(Arguments... arguments) {
    return Kernel::template run<Wide8>(arguments...);
  }
  static auto choose() {
    using Function = Result (*)(Arguments...);
    if constexpr (widest == 8)
      return for_registers<Function>(baseline, avx2, avx512);
    else
      return for_registers<Function>(baseline, avx2, avx2);
  }
  static inline auto const chosen_ = choose();
#else
  static constexpr Result (*chosen_)(Arguments...) = baseline;
#endif
};

} // namespace abbe::simd
