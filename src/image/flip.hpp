// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

namespace abbe::image {

/// Pixels per degree of visual angle of a 3840-pixel monitor 0.7 m wide seen from 0.7 m, the
/// setting of the paper.
inline constexpr double flip_pixels_per_degree = 67.0206;

/// The difference that a person sees who alternates between two images, per pixel, 0 (none) to 1
/// (as far apart as the green and the blue primary, or more). Symmetric in the two.
/// Takes display-referred images (tone_map); values are clamped to [0, 1].
/// @pre same size
/// @source Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference
///   Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020
std::vector<float> flip(Image const& reference, Image const& test,
                        double pixels_per_degree = flip_pixels_per_degree);

} // namespace abbe::image
