// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

/// What a scene says about the effects that are carried out: `effects { dispersion off }`.
namespace abbe::scene {

/// Effects that can be left out with a defined meaning (docs/language.md):
/// Spectral: off, the picture is made in r g b; on, in bands though nothing calls for it.
/// Reflection: neither `reflection` nor Fresnel reflection of glass; total reflection stays.
/// Refraction: every index is 1. Dispersion: every index is that of the d line.
/// Absorption, DistanceFade: of interiors. FilteringShadows: what lets light pass casts full
/// shadows. Caustics: the light that glass and mirrors throw; off, shadows of glass are filtered.
enum class Switch : std::uint8_t {
  Spectral,
  Reflection,
  Refraction,
  Dispersion,
  Absorption,
  DistanceFade,
  FilteringShadows,
  Caustics
};
/// Their words, in the order of the enumerators.
inline constexpr std::array<std::string_view, 8> switch_words{
    "spectral",   "reflection",    "refraction",        "dispersion",
    "absorption", "distance_fade", "filtering_shadows", "caustics"};

struct EffectOverride {
  Switch effect;
  bool on = false; ///< of Switch::Spectral only
  Span span;       ///< where it is written; invalid for the command line
};

struct EffectSettings {
  std::vector<EffectOverride> overrides; ///< at most one an effect
  bool strict = false; ///< it is an error when an override changes what the scene asks for
  Span strict_span;
};

} // namespace abbe::scene
