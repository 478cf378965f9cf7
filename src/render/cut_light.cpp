// SPDX-License-Identifier: MIT
#include "render/cut_light.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {

void CutLight::add(CutLight const& other) {
  paths += other.paths;
  sum += other.sum;
  worst_sample = std::max(worst_sample, other.worst_sample);
}

std::uint64_t CutLight::units_of(double lost) {
  // A sample that loses more than this has lost everything many times over.
  constexpr double most = 0x1p16;
  return static_cast<std::uint64_t>(std::ceil(std::min(lost, most) / unit));
}

} // namespace abbe::render
