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

/// @param point in texture space
PigmentValue evaluate_pigment(Stage const& stage, int pigment, Vec3 const& point, Beam const& beam,
                              Arena& arena);

/// How much of the surface is not see-through: scales diffuse and ambient light (POV-Ray's rule,
/// which changed with version 3.7).
double opacity(Stage const& stage, PigmentValue const& value, int lanes);

} // namespace abbe::render
