// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace abbe::image {

/// Nothing but success, or the reason of a failure.
using Status = Result<std::monostate>;

/// A picture as the renderer leaves it and as a file gives it: scene-referred, linear, unclamped.
///
/// Rows run from the top, pixels from the left; the values of one pixel are adjacent.
/// 1.0 in all three channels is the white that a display shows at full drive.
struct Image {
  int width = 0;
  int height = 0;
  /// Linear light, sRGB (Rec. 709) primaries, D65; three per pixel. Not clamped: negative values
  /// are normal for spectral colours, values above 1 for bright ones. Multiplied by alpha, if there
  /// is any.
  std::vector<float> rgb;
  /// Coverage 0..1, one per pixel; empty: opaque.
  std::vector<float> alpha;
  /// Spectral radiance, band_centres_nm.size() values per pixel; empty: no spectral data.
  std::vector<float> bands;
  std::vector<double> band_centres_nm; ///< strictly ascending
  std::vector<double> band_edges_nm;   ///< empty, or one more than centres, ascending
  /// Free text for the file: scene, settings, version. Keys are unique; PNG and TIFF keep
  /// their order, EXR sorts them.
  std::vector<std::pair<std::string, std::string>> metadata;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Most pixels an image may have, in memory or in a file.
inline constexpr std::int64_t max_pixels = std::int64_t{1} << 31;

/// A black opaque image. @pre width and height positive, at most max_pixels in all
Image make_image(int width, int height);

/// Do the sizes of the arrays agree with each other?
/// @error E0515 says which one does not
Status validate(Image const& image);

} // namespace abbe::image
