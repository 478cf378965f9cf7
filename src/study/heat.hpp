// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <string>
#include <vector>

namespace abbe::study {

/// Colour scales that grow evenly in lightness, legible to the colour-blind: sRGB, as matplotlib's
/// (Smith and van der Walt 2015, CC0), straight lines between ten of their colours.
enum class ColourScale { Magma, Viridis };
/// The ten colours, "#rrggbb".
std::vector<std::string> colours_of(ColourScale scale);

/// CIEDE2000 at the right end of the scale of error maps, which is log(1 + dE).
inline constexpr double most_delta_e = 20;
image::Image error_map(std::vector<float> const& delta_e, int width, int height);
/// Rays a pixel, logarithmic from 1 to `most`.
image::Image cost_map(image::Image const& rays, double most);

/// The bytes of a PNG of the picture as displayed. @param keep_as written there
Result<std::string> png_of(image::Image const& picture, std::string const& keep_as);
std::string base64(std::string const& bytes);

} // namespace abbe::study
