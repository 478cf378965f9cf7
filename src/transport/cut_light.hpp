// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abbe::transport {

/// Light that was dropped where paths end (Stage::adc_bailout, max_trace_level), as throughput of
/// red, green or blue, whichever lost most (bands at their weights, without sign): its product with
/// Stage::brightest bounds what is missing. Sums are integers: the same for any order.
struct CutLight {
  static constexpr double unit = 0x1p-32;
  std::uint64_t paths = 0;
  std::uint64_t sum = 0;   ///< of all samples, in units, rounded up once a sample
  double worst_sample = 0; ///< throughput
  void add(CutLight const& other);
  /// Rounded up.
  static std::uint64_t units_of(double lost);
};

/// A sum of light without sign in whole units, rounded up: the same for any order.
class LightSum {
public:
  void add(double light);
  double value() const { return static_cast<double>(units_) * unit; }

private:
  static constexpr double unit = 0x1p-44;
  std::uint64_t units_ = 0;
};

} // namespace abbe::transport
