// SPDX-License-Identifier: MIT
#pragma once

#include "plan/plan.hpp"
#include "plan/working_space.hpp"
#include "render/compile.hpp"
#include "render/render.hpp"

namespace abbe::render {

/// A picture of several passes is the mean of as many pictures of the same setting, each with
/// random numbers of its own, in the numbers in which their samples were averaged (as a scene with
/// `assumed_gamma` has them): more samples without a deeper grid, as many as there is time for.
///
/// The sums are 64-bit and of the whole picture (24 bytes a pixel, 8 a band of spectral output);
/// the finished rows are handed on when the last pass is done. A checkpoint keeps the tiles of
/// every pass.

/// How the picture of one pass is made. The first is made as a picture of one pass is; those after
/// it have other seeds and, in pixels that are sampled again, count their grids alone: the ray
/// through the middle is the same in each.
RenderOptions options_of_pass(RenderOptions const& options, int pass);

/// Is a second pass another picture than the first? Not unless something hangs on random numbers:
/// a stochastic mode of dispersion, the grid of method 1 with jitter, or the points of method 3.
bool passes_differ(plan::Plan const& plan, AntiAliasing const& anti_aliasing);

/// Memory that the sums of several passes take.
double bytes_of_sums(plan::Plan const& plan, RenderOptions const& options);

/// The mean of RenderOptions::passes pictures.
/// @param space of the channels when they are r g b
RenderResult make_passes(Stage const& stage, RenderOptions const& options,
                         plan::WorkingSpace const& space);

} // namespace abbe::render
