// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"
#include "study/banding.hpp"

#include <optional>
#include <span>
#include <vector>

namespace abbe::study {

/// How far a picture is from the reference.
struct Errors {
  /// Mean over pixels and X, Y, Z of (test - reference)^2 / (reference^2 + 0.01 m^2), m the mean
  /// luminance of the reference.
  double relative_mse = 0;
  double relative_mse_rgb = 0; ///< the same of linear r, g and b
  double delta_e_mean = 0;     ///< CIEDE2000 of the pictures as displayed (image::compare)
  double delta_e_p99 = 0;      ///< 99 % of the pixels are not above it
  double flip = 0;             ///< mean, 0..1
  double banding = 0;          ///< study/banding.hpp; CIELAB units a pixel
};

/// The relative root mean square error of one picture in two parts, from several of different
/// seeds: relative_mse = bias^2 + noise^2 on average.
struct Spread {
  double noise = 0; ///< root of the variance over seeds, relative as relative_mse
  double bias = 0;  ///< of the mean picture, what the noise left in the mean accounts for taken off
};

/// @pre the pictures have one size
Errors measure_errors(image::Image const& reference, image::Image const& test,
                      DispersionField const& field);

/// One picture: nothing, unless it is the only one that there is (deterministic).
std::optional<Spread> measure_spread(image::Image const& reference,
                                     std::span<image::Image const> tests, bool deterministic);

/// CIEDE2000 of each pixel, as displayed.
std::vector<float> delta_e_map(image::Image const& reference, image::Image const& test);
double mean(std::vector<float> const& values);

} // namespace abbe::study
