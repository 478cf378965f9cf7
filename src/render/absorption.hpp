// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace abbe::render {

/// What is left of light after an optical depth: exp(-depth), to two units in the last place; 1 at
/// 0, 0 at infinity. The same bits on every machine, which the exp() of a system's library does not
/// promise: it differs with the processor.
double transmittance(double optical_depth);

/// Multiplies each of `count` values by the transmittance of its depth, with the same bits, four at
/// a time. @param depths has room for whole lanes of four; what is beyond `count` is overwritten
void absorb_lanes(double* depths, std::size_t count, double* values);

} // namespace abbe::render
