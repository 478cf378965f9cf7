// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace abbe::plan {

/// The lights of a scene and the colours that they fall on, on a grid of bands: what a
/// representation of light is fitted to.
struct Palette {
  std::vector<std::vector<double>> lights;  ///< of lamps, glows, background and sky
  std::vector<std::vector<double>> colours; ///< of surfaces and of what they reflect
  /// Light after none, one or two of the colours.
  std::vector<std::vector<double>> products() const;
};

/// Colours beyond this number are left out: the first ones found count.
inline constexpr std::size_t palette_limit = 96;

/// Light that fell on two colours is looked at for this many of them, so that pairs stay in the
/// hundreds.
inline constexpr std::size_t palette_pair_limit = 24;

/// A flat light is always among them: rgb colours are multiples of white.
Palette find_palette(scene::Scene const& scene, optics::Bands const& grid);

/// Wavelengths of all emission lines in the scene's lights (optics::Spectrum::split); ascending.
std::vector<double> find_lines_nm(scene::Scene const& scene, optics::Bands const& bands);

} // namespace abbe::plan
