// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace abbe::transport {

/// Counts of one thread, added up for the report.
struct RayCounts {
  std::uint64_t camera = 0, reflected = 0, refracted = 0, monochromatic = 0, shadow = 0;
  std::uint64_t splits = 0; ///< refractions of a polychromatic ray into monochromatic ones
  void add(RayCounts const& other) { combine(other, 1); }
  void subtract(RayCounts const& other) { combine(other, ~std::uint64_t{0}); }
  std::uint64_t total() const { return camera + reflected + refracted + monochromatic + shadow; }

private:
  void combine(RayCounts const& other, std::uint64_t times) {
    camera += times * other.camera;
    reflected += times * other.reflected;
    refracted += times * other.refracted;
    monochromatic += times * other.monochromatic;
    shadow += times * other.shadow;
    splits += times * other.splits;
  }
};

} // namespace abbe::transport
