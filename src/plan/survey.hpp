// SPDX-License-Identifier: MIT
#pragma once

#include "plan/plan.hpp"

#include <optional>
#include <vector>

namespace abbe::plan {

/// What the overrides come to: the scene's `effects` block and the command line, which goes first.
class Choices {
public:
  /// As the scene asks for, nothing overridden.
  Choices() = default;
  Choices(scene::EffectSettings const& settings, Overrides const& overrides);

  /// Does anything differ from what the scene asks for?
  bool any() const;
  bool off(scene::Switch effect) const { return off_[static_cast<std::size_t>(effect)]; }
  bool forces_bands() const { return forces_bands_; }
  std::optional<scene::DispersionMode> const& dispersion() const { return dispersion_; }
  /// Who forces the bands: "--spectral", "--bands", "effects { spectral on }".
  std::string const& why_bands() const { return why_bands_; }
  Span why_bands_span() const { return why_bands_span_; }

private:
  bool off_[scene::switch_words.size()] = {};
  bool forces_bands_ = false;
  std::optional<scene::DispersionMode> dispersion_;
  std::string why_bands_;
  Span why_bands_span_;
};

struct Survey {
  std::vector<Finding> findings = std::vector<Finding>(effect_count);
  /// What cannot be carried out without bands: a spectrum, a metal.
  Finding needs_bands;
  /// Objects of the scene (numbers, ascending) that no ray can reach: those that would call for
  /// something, and those that are not to be seen at all.
  std::vector<std::size_t> out_of_reach;
};

/// Walks the scene and notes the first place that calls for each effect.
///
/// Objects that no ray meets call for nothing: those with no_image, no_reflection and no_shadow,
/// and, where nothing in reach reflects or refracts, those out of reach (plan/reach.hpp). An
/// interior calls for refraction and dispersion only where light can get at it: the object lets
/// light pass somewhere, or reflects by Fresnel, or is open, or the camera stands in it.
Survey survey(scene::Scene const& scene, Choices const& choices);

} // namespace abbe::plan
