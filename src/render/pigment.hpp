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

/// Of a pigment without a pattern: the same everywhere.
inline PigmentValue plain_pigment(CompiledPigment const& pigment, Beam const& beam, Arena& arena) {
  PigmentValue value{arena.take<double>(static_cast<std::size_t>(beam.lanes)),
                     pigment.colour.filter, pigment.colour.transmit};
  for (int k = 0; k < beam.lanes; ++k) value.colour[k] = pigment.colour.value[beam.channel[k]];
  return value;
}

/// @param point in texture space
PigmentValue evaluate_pigment(Stage const& stage, int pigment, Vec3 const& point, Beam const& beam,
                              Arena& arena);

/// How much of the surface is not see-through: scales diffuse and ambient light (POV-Ray's rule,
/// which changed with version 3.7).
double opacity(Stage const& stage, PigmentValue const& value, int lanes);

} // namespace abbe::render
