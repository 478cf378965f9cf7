// SPDX-License-Identifier: MIT
#pragma once

#include "simd/wide_lane.hpp"

#include <cstdlib>
#include <string_view>

namespace abbe::simd {

/// What kernels are compiled for.
enum class Registers { Baseline, Avx2, Avx512 };

/// The widest that the machine has, or what the environment says that is no wider:
/// ABBE_REGISTERS=baseline, avx2 or avx512. All give the same bits; the tests compare them.
inline Registers registers() {
#if ABBE_HAS_WIDE_LANES
  static Registers const chosen = [] {
    char const* const given = std::getenv("ABBE_REGISTERS");
    std::string_view const wanted = given == nullptr ? "" : given;
    if (!__builtin_cpu_supports("avx2") || wanted == "baseline") return Registers::Baseline;
    bool const widest = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")
                        && __builtin_cpu_supports("avx512vl");
    return widest && wanted != "avx2" ? Registers::Avx512 : Registers::Avx2;
  }();
  return chosen;
#else
  return Registers::Baseline;
#endif
}

/// The one of these functions, or tables of functions, that is for the machine's registers.
template <class Kernels>
Kernels for_registers(Kernels baseline, Kernels avx2, Kernels avx512) {
  switch (registers()) {
  case Registers::Baseline:
    return baseline;
  case Registers::Avx2:
    return avx2;
  case Registers::Avx512:
    return avx512;
  }
  return baseline;
}

} // namespace abbe::simd
