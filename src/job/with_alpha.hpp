// SPDX-License-Identifier: MIT
#pragma once

#include "job/job.hpp"

namespace abbe::job {

/// run() with an alpha channel: how much of the background each pixel covers is rendered first
/// (plan::background_only), without lamps and without a checkpoint, then the picture with what is
/// in front of the background. The sink's rows have Image::alpha; colours are multiplied by it.
/// @param plan of the scene @param overrides that the plan was made with
Outcome run_with_alpha(scene::Scene&& scene, plan::Plan const& plan,
                       plan::Overrides const& overrides, Options const& options, Sink& sink);

} // namespace abbe::job
