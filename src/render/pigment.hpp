// SPDX-License-Identifier: MIT
#pragma once

#include "render/arena.hpp"
#include "render/beam.hpp"
#include "render/stage.hpp"

namespace abbe::render {

/// A pigment at a point, for the lanes of a beam.
struct PigmentValue {
  double* colour = nullptr; ///< per lane, in the arena
  double filter = 0;
  double transmit = 0;
};

/// Of a pigment without a pattern: the same everywhere. @tparam Lanes of the beam; 0: any number
template <int Lanes>
PigmentValue plain_pigment(CompiledPigment const& pigment, Beam const& beam, Arena& arena) {
  PigmentValue value{arena.take<double>(static_cast<std::size_t>(beam.lanes)),
                     pigment.colour.filter, pigment.colour.transmit};
  int const lanes = Lanes > 0 ? Lanes : beam.lanes;
  for (int k = 0; k < lanes; ++k) value.colour[k] = pigment.colour.value[beam.channel[k]];
  return value;
}

/// @param point in texture space
/// @tparam Lanes of the beam: 1, 3, or 0 for any number
template <int Lanes>
PigmentValue evaluate_pigment(Stage const& stage, int pigment, Vec3 const& point, Beam const& beam,
                              Arena& arena);

/// How much of the surface is not see-through: scales diffuse and ambient light (POV-Ray's rule,
/// which changed with version 3.7).
double opacity(Stage const& stage, PigmentValue const& value, int lanes);

} // namespace abbe::render
