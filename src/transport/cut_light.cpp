// SPDX-License-Identifier: MIT
#include "transport/cut_light.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport {
namespace {

/// What loses more than this has lost everything many times over.
constexpr double most = 0x1p16;

} // namespace

void CutLight::add(CutLight const& other) {
  paths += other.paths;
  sum += other.sum;
  worst_sample = std::max(worst_sample, other.worst_sample);
}

std::uint64_t CutLight::units_of(double lost) {
  return static_cast<std::uint64_t>(std::ceil(std::min(lost, most) / unit));
}

void LightSum::add(double light) {
  if (!(light > 0)) return;
  constexpr auto full = static_cast<std::uint64_t>(most / unit);
  auto const more = static_cast<std::uint64_t>(std::ceil(std::min(light, most) / unit));
  units_ = std::min(full, units_ + more);
}

} // namespace abbe::transport
