// SPDX-License-Identifier: MIT
#include "transport/segments/fade.hpp"

#include "simd/math.hpp"

namespace abbe::transport {

void Fade::leave(Passage const& way) const {
  // In POV-Ray a power of 0 or below takes nothing from light on its way from a lamp.
  if (way.to_lamp && !(power_ > 0)) return;
  double* light = way.light;
  std::uint16_t const* channel = way.channel;
  for (std::size_t r = 0; r < way.rays; ++r) {
    double const depth = way.distance[r] / distance_;
    bool const exponential = power_ >= 1000;
    double const share = exponential ? 0 : 1 / (1 + simd::pow(depth, power_));
    for (std::size_t c = 0; c < way.each; ++c, ++channel, ++light) {
      double const colour = colour_.empty() ? 0 : colour_[*channel];
      *light *= exponential ? simd::exp(-(1 - colour) * depth) : colour + (1 - colour) * share;
    }
  }
}

} // namespace abbe::transport
