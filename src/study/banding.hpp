// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <vector>

namespace abbe::study {

/// Where a picture's colours run, and how clearly: the direction in which dispersion has drawn them
/// out. Principal axis of the structure tensor of a* and b*, summed over 5 x 5 pixels.
struct DispersionField {
  int width = 0, height = 0;
  std::vector<float> dx, dy; ///< unit vectors, either sign
  std::vector<float> weight; ///< difference of the roots of its eigenvalues; 0: no direction
};
DispersionField dispersion_field(image::Image const& reference);

/// Bands: error that changes along the direction of dispersion more than across it. With e the
/// error in CIELAB of the displayed pictures, the root of the weighted mean of
/// |de/dalong|^2 - |de/dacross|^2, in CIELAB units a pixel; 0 where that is negative. Noise changes
/// alike in both directions and cancels.
double banding(image::Image const& reference, image::Image const& test,
               DispersionField const& field);

} // namespace abbe::study
