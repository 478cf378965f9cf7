// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

namespace abbe::plan {

/// What POV-Ray's option +Q leaves out of a finished scene:
/// - below 9: fog and rainbows
/// - below 8: reflection, normals
/// - below 6: patterns of pigments with a `quick_color`, and what is behind transparent surfaces,
///   which then cast whole shadows
/// - below 4: shadows
/// - below 2: lamps; surfaces have the colour of their pigment
/// @param quality 0 to 11; 9 and above: nothing
void lower_quality(scene::Scene& scene, int quality);

/// The scene whose picture is the share of the background that each point of it shows: all that is
/// in front is black, and mirrors nothing. 1 minus the grey of that is an alpha channel, as
/// POV-Ray's +UA makes it. A `background` covers what its transmit leaves of it, from #version 3.7
/// on; below, the background is all transparent.
scene::Scene background_only(scene::Scene scene);

/// What is in front of the background as background_only() has it: the light that goes with that
/// alpha.
void leave_out_background(scene::Scene& scene);

} // namespace abbe::plan
