// SPDX-License-Identifier: MIT
#include "transport/cut_light.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

/// What loses more than this has lost everything many times over.
constexpr double most = 0x1p16;

/// The least whole number that is not below x >= 0.
std::uint64_t rounded_up(double x) {
  auto const whole = static_cast<std::uint64_t>(x);
  return whole + (static_cast<double>(whole) < x ? 1 : 0);
}

} // namespace

void CutLight::add(CutLight const& other) {
  paths += other.paths;
  sum += other.sum;
  worst_sample = std::max(worst_sample, other.worst_sample);
}

std::uint64_t CutLight::units_of(double lost) {
  return lost > 0 ? rounded_up(std::min(lost, most) / unit) : 0;
}

void LightSum::add(double light) {
  if (!(light > 0)) return;
  constexpr auto full = static_cast<std::uint64_t>(most / unit);
  units_ = std::min(full, units_ + rounded_up(std::min(light, most) / unit));
}

} // namespace abbe::transport
