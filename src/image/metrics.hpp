// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"
#include "image/tone_map.hpp"

namespace abbe::image {

struct CompareOptions {
  /// A pixel differs when one of its 8-bit sRGB codes differs by more than this.
  double threshold_codes = 0;
  /// How both images come to the display; automatic exposure is that of the reference for both.
  ToneOptions tone{};
};

/// How far a test image is from a reference. "Linear": on the values of the images as they are;
/// "display": after the mapping to [0, 1] of CompareOptions, "sRGB": on its sRGB encoding, 0..1.
/// Averages go over pixels and channels. An infinite value in both images at a place is no
/// difference.
struct Metrics {
  double rmse_linear = 0;
  double rmse_srgb = 0;
  double psnr_linear_db = 0; ///< peak 1; infinite for equal images
  double psnr_srgb_db = 0;   ///< peak 1; on the 8-bit codes; infinite for equal codes
  double max_linear = 0;     ///< largest difference of a channel
  double max_codes = 0;      ///< the same in 8-bit sRGB codes, 0..255
  /// mean((test - reference)^2 / (reference^2 + 0.01 m^2)), m the mean luminance of the reference.
  /// NaN when the reference is all black and the test is not.
  double relative_mse = 0;
  /// The same of X, Y and Z instead of r, g and b.
  double relative_mse_xyz = 0;
  double differing_share = 0; ///< pixels beyond threshold_codes, 0..1

  /// CIEDE2000 between the display images, D65.
  double delta_e_mean = 0;
  double delta_e_p95 = 0; ///< the value that 95 % of the pixels do not exceed
  double delta_e_p99 = 0;
  double delta_e_max = 0;
  double delta_e_share_above_1 = 0;
  double delta_e_share_above_2_3 = 0; ///< 2.3: the just noticeable difference of Mahy et al. 1994

  double flip_mean = 0; ///< FLIP between the display images, 0..1
  double flip_max = 0;

  std::size_t not_a_number = 0; ///< values that are NaN in either; they count as 0 above
};

/// @error E0517 the sizes differ
Result<Metrics> compare(Image const& reference, Image const& test,
                        CompareOptions const& options = {});

/// |test - reference| of the sRGB-encoded display images, channel by channel, times `gain`, as an
/// image that write_png() writes with just these values (clipped at 1).
/// @error E0517 the sizes differ
Result<Image> difference_image(Image const& reference, Image const& test, double gain = 1,
                               ToneOptions const& tone = {});

} // namespace abbe::image
