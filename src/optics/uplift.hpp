// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"

#include <vector>

namespace abbe::optics {

/// Band values of a smooth spectrum whose colour is a given linear sRGB: bands.rgb(uplift(rgb)) =
/// rgb to 1e-9 for every rgb and any n >= 3, as reflectance or (values are relative to D65) as
/// light.
///
/// The spectrum is a sigmoid of a quadratic in wavelength, fitted against the weights of these very
/// bands, with values in (0, 1). Equal components give exactly flat. Where the sigmoid saturates
/// (pure primaries) or the bands are too few for any values in [0, 1], the rest is made up by the
/// smallest change that is exact, within [0, 1] if that can be done, else slightly outside.
/// Components above 1: the spectrum of rgb / max, times max. Negative components:
/// uplift(max(rgb, 0)) - uplift(max(-rgb, 0)). n < 3: flat with the luminance of rgb.
/// @source W. Jakob and J. Hanika, Computer Graphics Forum 38(2), 2019
std::vector<double> uplift(Vec3 const& rgb, Bands const& bands);

} // namespace abbe::optics
