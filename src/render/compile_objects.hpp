// SPDX-License-Identifier: MIT
#pragma once

#include "render/media_compiler.hpp"
#include "render/pigment_compiler.hpp"

namespace abbe::render {

/// Flattens the object graph into primitives, solids and surfaces of the stage, relative to the
/// camera.
///
/// Unions become several solids, so that they keep their inner faces as in POV-Ray. A union inside
/// an intersection or difference is distributed over it for the same reason where something of it
/// lets light pass; where all is opaque its inner faces can never be seen and it is one solid.
/// @param taken the scene's objects, given up one by one as they are compiled; or null
void compile_objects(scene::Scene const& scene, std::deque<scene::Object>* taken,
                     plan::Plan const& plan, ColourCompiler& colours, PigmentCompiler& pigments,
                     MediaCompiler& media, Stage& stage);

} // namespace abbe::render
