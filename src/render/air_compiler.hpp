// SPDX-License-Identifier: MIT
#pragma once

#include "render/colour_compiler.hpp"
#include "transport/air/air_effect.hpp"

namespace abbe::render {

/// What is in the air of a scene, the nearest to the camera first: fog, and rainbows behind it, as
/// in POV-Ray. A new effect: a line here.
transport::Air compile_air(scene::Scene const& scene, ColourCompiler& colours);

} // namespace abbe::render
