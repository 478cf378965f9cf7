// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "plan/working_space.hpp"
#include "render/render.hpp"

/// When a pixel of method 3 (Samples) is known well enough.
namespace abbe::render {

/// The standard error of a pixel as displayed (sRGB codes from 0 to 1, root of the mean square over
/// r, g and b), from that of its mean: half of what an error up and one down differ by. Light above
/// white has none, for it is shown as white.
/// @param space of the numbers
double shown_error(Vec3 const& mean, Vec3 const& standard_error, plan::WorkingSpace const& space);

/// What a pixel's mean can be off by because none of its samples met something that covers a part
/// of it. Samples that are evenly apart miss what covers up to 1 / count of the pixel: that is
/// evenly distributed, and so likely.
/// @param contrast how far from the mean what may be there is
Vec3 missed(Vec3 const& contrast, int count);

/// The error that is good enough for a pixel that has taken so many rays: Samples::error at most,
/// and less the cheaper the pixel is. Errors of all pixels together are least for a time when each
/// ray takes as much off them: when their squares are to each other as the rays.
double tolerance(Samples const& samples, double rays);

} // namespace abbe::render
