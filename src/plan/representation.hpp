// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "optics/channel_set.hpp"
#include "scene/scene.hpp"

namespace abbe::plan {

/// The channels that a scene is rendered in.
/// @param bands as the scene and the command line set them
/// @param disperses some material parts light by its wavelength: a basis then spans that too
/// @param draws some material draws its wavelengths (stochastic modes)
/// @error E0432 a basis and a material that draws
Result<optics::ChannelSet> make_channels(scene::Scene const& scene,
                                         scene::Representation const& representation,
                                         optics::Bands const& bands, bool disperses, bool draws);

/// "16 bands", "16 bands and 5 lines", "a basis of 6".
std::string describe(optics::ChannelSet const& channels);

} // namespace abbe::plan
