// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "surface/textures.hpp"

#include <algorithm>

namespace abbe::surface {

/// A pigment at a point, for the lanes of a ray.
struct PigmentValue {
  double* colour = nullptr; ///< per lane; the room is given
  double filter = 0;
  double transmit = 0;
};

/// Of a pigment without a pattern: the same everywhere. @tparam Lanes of the ray; 0: any number
template <int Lanes>
void plain_pigment(Textures const& textures, CompiledPigment const& pigment,
                   std::uint16_t const* channel, int lanes, PigmentValue& out) {
  out.filter = pigment.filter;
  out.transmit = pigment.transmit;
  double const* const colour = textures.colour(pigment);
  for (int k = 0; k < (Lanes > 0 ? Lanes : lanes); ++k) out.colour[k] = colour[channel[k]];
}

/// Where a pigment is asked for.
struct PigmentSpot {
  Vec3 point;                            ///< in texture space
  texture::Sight const* sight = nullptr; ///< null: not on a surface
};
/// @param point in the space of the layer @param sight outlives what is returned
inline PigmentSpot spot_of(Textures const& textures, CompiledLayer const& layer, Vec3 const& point,
                           texture::Sight const& sight) {
  return {textures.to_texture(layer, layer.uv ? Vec3(sight.uv, 0.0) : point), &sight};
}
/// @tparam Lanes of the ray: 1, 3, or 0 for any number
template <int Lanes>
void evaluate_pigment(Textures const& textures, int pigment, PigmentSpot const& spot,
                      std::uint16_t const* channel, int lanes, PigmentValue& out, Arena& arena);

/// How much of the surface is not see-through: scales diffuse and ambient light (POV-Ray's rule,
/// which changed with version 3.7).
inline double opacity(Textures const& textures, PigmentValue const& value, int lanes) {
  if (textures.opacity_version >= 3.7) return 1 - value.filter - value.transmit;
  double brightest = 0;
  for (int k = 0; k < lanes; ++k) brightest = std::max(brightest, value.colour[k]);
  return 1 - (value.filter * brightest + value.transmit);
}

} // namespace abbe::surface
