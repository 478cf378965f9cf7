// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <optional>

/// What an interior means optically.
namespace abbe::plan {

/// The mode that governs a material: the override, else its own, else the scene's default; what is
/// deterministic or adaptive shares rays as `spectral { merge }` says, where that is given.
/// POV-Ray's own form (`ior` with `dispersion`) follows the scene's default too.
scene::DispersionMode effective_mode(scene::Interior const& interior,
                                     scene::Settings const& settings,
                                     std::optional<scene::DispersionMode> const& override_mode);

/// The index where no wavelength is distinguished: nd of a glass, else `ior`.
double plain_index(scene::Interior const& interior);

/// The interior's glass, POV-Ray's `ior` with `dispersion` made one; null where the index is one
/// number.
std::shared_ptr<optics::Glass const> dispersive_glass(scene::Interior const& interior);

} // namespace abbe::plan
