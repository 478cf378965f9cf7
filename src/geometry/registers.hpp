// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/wide_lane.hpp"

#include <cstdlib>
#include <string_view>

namespace abbe::geometry {

/// Are the kernels for AVX2 to be used? Where the machine has it, unless the environment says
/// ABBE_REGISTERS=baseline. Both give the same bits; the tests compare them.
inline bool has_wide_registers() {
#if ABBE_HAS_WIDE_LANES
  static bool const has = [] {
    char const* const wanted = std::getenv("ABBE_REGISTERS");
    return __builtin_cpu_supports("avx2")
           && !(wanted != nullptr && std::string_view(wanted) == "baseline");
  }();
  return has;
#else
  return false;
#endif
}

} // namespace abbe::geometry
