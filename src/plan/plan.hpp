// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/source.hpp"
#include "optics/channel_set.hpp"
#include "scene/scene.hpp"

#include <array>
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
  Csg,
  AreaLights,
  LightGroups,
  Air,
  Caustics
};
inline constexpr int effect_count = 16;
std::string_view effect_name(Effect);
/// The switch that puts it off, where there is one.
std::optional<scene::Switch> switch_of(Effect);

struct Finding {
  bool on = false;
  std::string reason; ///< "N-SF11 disperses"
  Span span;          ///< the first place that calls for it; may be invalid
  /// What made it other than the scene asks for: "effects { dispersion off }"; else empty. When
  /// that put it off, reason and span say what asked for it.
  std::string overridden;
  Span overridden_at; ///< invalid for the command line
};

/// What the command line may override. It goes before the scene's own `effects` block.
struct Overrides {
  std::optional<int> bands;                                ///< --bands
  std::optional<scene::DispersionMode> dispersion;         ///< --dispersion: for every material
  std::optional<scene::Representation> representation;     ///< --representation
  std::optional<scene::SpectralSettings::Spacing> spacing; ///< --spacing
  bool spectral = false;                                   ///< --spectral
  std::vector<scene::EffectOverride> effects;              ///< of the probe of `abbe explain`
  bool lenient = false;                                    ///< the probe's: `strict` does not count
};

struct Plan {
  std::vector<Finding> findings = std::vector<Finding>(effect_count);
  /// nullopt: the scene is rendered in r g b.
  std::optional<optics::ChannelSet> spectral;
  std::optional<scene::DispersionMode> dispersion_override;
  std::array<bool, scene::switch_words.size()> off{}; ///< put off by an override
  /// Objects of the scene, by number and ascending, that no ray can reach and that would cost
  /// something: they are left out.
  std::vector<std::size_t> out_of_reach;

  bool is_off(scene::Switch effect) const { return off[static_cast<std::size_t>(effect)]; }
  bool has(Effect e) const { return findings[static_cast<std::size_t>(e)].on; }
};

/// @error E0416 band settings that cannot be (count, range), E0430 spectral transport is off and
/// something needs it, E0431 `effects strict` and an override changes what the scene asks for
Result<Plan> make_plan(scene::Scene const& scene, Overrides const& overrides = {});
/// The transport, then one line an effect: on or off, why, where; overrides too.
std::string describe(Plan const& plan);
/// The first line of that, and a line of it without its end.
std::string describe_transport(Plan const& plan);
/// The channels: "16 bands", "16 bands and 5 lines", "a basis of 6", "r g b".
std::string describe_channels(Plan const& plan);
std::string describe(Plan const& plan, Effect effect);

} // namespace abbe::plan
