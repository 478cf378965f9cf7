// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "optics/comb.hpp"

#include <cstdint>
#include <string>

namespace abbe::scene {

/// How a material that disperses splits a ray. `Inherit`: the scene's default.
/// None: the index of the d line for every wavelength. Deterministic: one ray a band, at its
/// middle. Adaptive: the same, but bands go together as long as they land less than
/// `tolerance_px` apart. Stochastic: the teeth of a comb.
struct DispersionMode {
  enum class Kind : std::uint8_t { Inherit, None, Deterministic, Adaptive, Stochastic };
  Kind kind = Kind::Inherit;
  optics::Comb comb;         ///< of Stochastic
  double tolerance_px = 0.5; ///< of Adaptive
  Span span;
};

/// As the language writes it: "stochastic rays 4 jitter blue_noise 1".
std::string text(DispersionMode const& mode);

} // namespace abbe::scene
