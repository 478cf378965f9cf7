// SPDX-License-Identifier: MIT
#pragma once

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "transport/stage.hpp"

namespace abbe::render {

using surface::Channels, surface::CompiledFinish, surface::CompiledLayer, surface::CompiledPattern,
    surface::CompiledPigment, surface::CompiledReflection, surface::SurfaceLayers;
using transport::camera_bit, transport::reflection_bit, transport::opaque_shadow_bit,
    transport::filter_shadow_bit;
using transport::CompiledSolid, transport::Medium, transport::Stage;

/// Flattens a scene. The plan says which transport is used.
/// The scene must have passed evaluation: nothing here can fail on user input.
Stage compile(scene::Scene const& scene, plan::Plan const& plan);
/// The same; the scene's objects are given up one by one, so that large scenes are not there twice.
Stage compile(scene::Scene&& scene, plan::Plan const& plan);

} // namespace abbe::render
