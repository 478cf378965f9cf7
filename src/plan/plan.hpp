// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/source.hpp"
#include "optics/bands.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

/// Which effects does this scene call for, and why? The renderer carries out these and no others.
namespace abbe::plan {

enum class Effect : std::uint8_t {
  SpectralTransport,
  Reflection,
  Refraction,
  ContactOfMedia,
  Dispersion,
  StochasticDispersion,
  Absorption,
  DistanceFade,
  FilteringShadows,
  LayeredTextures,
  Patterns,
  Csg
};
inline constexpr int effect_count = 12;
std::string_view effect_name(Effect);

struct Finding {
  bool on = false;
  std::string reason; ///< "glass N-SF11 with dispersion { deterministic }"
  Span span;          ///< the first place that calls for it; may be invalid
};

/// What the command line may override.
struct Overrides {
  std::optional<int> bands;                        ///< --bands
  std::optional<scene::DispersionMode> dispersion; ///< --dispersion: for every material
  bool spectral = false;                           ///< --spectral
};

struct Plan {
  std::vector<Finding> findings = std::vector<Finding>(effect_count);
  /// nullopt: the scene is rendered in r g b.
  std::optional<optics::Bands> bands;
  std::optional<scene::DispersionMode> dispersion_override;

  bool has(Effect e) const { return findings[static_cast<std::size_t>(e)].on; }
};

/// @error E0416 band settings that cannot be (count, range)
Result<Plan> make_plan(scene::Scene const& scene, Overrides const& overrides = {});
/// One line an effect: on or off, why, where.
std::string describe(Plan const& plan);

} // namespace abbe::plan
