// SPDX-License-Identifier: MIT
#include "transport/segments/absorption.hpp"

#include "simd/math.hpp"
#include "simd/native.hpp"

namespace abbe::transport {
namespace {

struct Absorb {
  template <class L>
  static void run(double const* depths, std::size_t count, double* light) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t at) {
      Lanes const depth = lane::load<Lanes>(depths + at);
      // Depth 0 takes nothing, also from light that is infinite.
      lane::store(light + at, lane::load<Lanes>(light + at) * lane::exp(-depth));
    });
  }
};
simd::Native<Absorb> const absorb;

} // namespace

void Absorption::along(Passage const& way) const {
  constexpr std::size_t some = 512;
  alignas(64) double depth[some], light[some];
  depth[0] = light[0] = 0;
  std::size_t lanes = 0;
  double* to = way.light;
  auto const finish = [&] {
    for (std::size_t k = 0; k < lanes; ++k) light[k] = to[k];
    std::size_t const whole = (lanes + 7) / 8 * 8;
    for (std::size_t k = lanes; k < whole; ++k) depth[k] = light[k] = 0;
    absorb(depth, whole, light);
    for (std::size_t k = 0; k < lanes; ++k) to[k] = light[k];
    to += lanes;
    lanes = 0;
  };
  std::uint16_t const* channel = way.channel;
  for (std::size_t r = 0; r < way.rays; ++r)
    for (std::size_t c = 0; c < way.each; ++c, ++channel) {
      double const alpha = alpha_[*channel];
      depth[lanes] = alpha != 0 ? alpha * way.distance[r] : 0;
      if (++lanes == some) finish();
    }
  finish();
}

} // namespace abbe::transport
