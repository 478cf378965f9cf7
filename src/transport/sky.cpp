// SPDX-License-Identifier: MIT
#include "transport/sky.hpp"

#include "surface/pigment.hpp"

#include <algorithm>

namespace abbe::transport {

bool has_sky(Stage const& stage) {
  return !stage.sky_pigments.empty() || !stage.background.empty();
}

void find_sky(Stage const& stage, Arena& arena, Vec3 const& direction,
              std::uint16_t const* channels, std::size_t lanes, double* out) {
  auto const background = [&](std::size_t k) {
    return stage.background.empty() ? 0 : stage.background[channels[k]];
  };
  if (stage.sky_pigments.empty()) {
    for (std::size_t k = 0; k < lanes; ++k) out[k] = background(k);
    return;
  }
  Arena::Scope const scope(arena);
  Vec3 const point = stage.to_sky_linear * direction + stage.to_sky_offset;
  auto* left = arena.take<double>(lanes);
  std::fill_n(left, lanes, 1.0);
  std::fill_n(out, lanes, 0.0);
  // Below version 3.7, a layer's colour filters the background, but not the layers under it.
  bool const plain_layers = stage.textures.opacity_version < 3.7;
  double filter = 1, transmit = 1, through = 1; // all layers above
  surface::PigmentValue pigment{arena.take<double>(lanes)};
  for (auto number = stage.sky_pigments.rbegin(); number != stage.sky_pigments.rend(); ++number) {
    surface::evaluate_pigment<0>(stage.textures, *number, {point}, channels,
                                 static_cast<int>(lanes), pigment, arena);
    double const opaque = 1 - pigment.filter - pigment.transmit;
    for (std::size_t k = 0; k < lanes; ++k) {
      double const share = opaque * (plain_layers ? through : left[k]);
      out[k] += share * pigment.colour[k] * stage.sky_emission[channels[k]];
      left[k] *=
          plain_layers ? pigment.colour[k] : pigment.filter * pigment.colour[k] + pigment.transmit;
    }
    filter *= pigment.filter;
    transmit *= pigment.transmit;
    through = filter + transmit;
  }
  for (std::size_t k = 0; k < lanes; ++k) {
    if (plain_layers) left[k] = filter * left[k] + transmit;
    out[k] += left[k] * background(k);
  }
}

} // namespace abbe::transport
