// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace abbe {

/// A number in [0, 1) for each pixel such that neighbours' differ much: a dither array of 64 x 64,
/// repeated, whose error has no low frequencies. Made when it is first asked for.
/// @source R. Ulichney, The void-and-cluster method for dither array generation, SPIE 1913, 1993
double blue_noise(std::int64_t x, std::int64_t y);

} // namespace abbe
