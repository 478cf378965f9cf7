// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "image/image.hpp"

#include <cstdint>
#include <vector>

namespace abbe::image {

/// What becomes of colours that a display cannot show. None of them changes a colour inside [0,
/// 1]^3.
enum class Gamut {
  /// Each channel on its own to [0, 1], as POV-Ray does. Shifts the hue of spectral colours.
  Clip,
  /// Negative channels (outside the triangle of the primaries): mixed with the grey of the same
  /// luminance until none is negative, which keeps luminance and hue (the straight line to white
  /// in u'v'). Then channels above 1 are clipped, as POV-Ray does. Luminance <= 0 is black.
  Standard,
  /// Negative channels as in Standard; a colour with a channel above 1 is scaled as a whole
  /// until its largest is 1: chromaticity stays, luminance falls.
  Hue,
};

struct ToneOptions {
  double exposure_ev = 0;     ///< factor 2^exposure_ev on linear light, before anything else
  bool auto_exposure = false; ///< adds what brings the geometric mean of luminances > 0 to 0.18
  Gamut gamut = Gamut::Standard;
};

/// What the mapping had to do.
struct ToneReport {
  double exposure_ev = 0;       ///< applied, the automatic part included
  std::size_t negative = 0;     ///< pixels with a negative channel
  std::size_t over_range = 0;   ///< pixels with a channel above 1 (after exposure)
  std::size_t not_a_number = 0; ///< pixels with NaN, shown black
};

/// One colour, linear sRGB, to [0, 1]^3. A NaN gives black, an infinity the largest finite float.
Vec3 map_to_gamut(Vec3 rgb, Gamut gamut);

/// log2(0.18 / geometric mean of the luminances that are > 0); 0 when there is none.
double automatic_exposure_ev(Image const& image);

/// The display-referred image: linear light in [0, 1], same size, alpha and metadata kept, no
/// bands.
Image tone_map(Image const& image, ToneOptions const& options = {}, ToneReport* report = nullptr);

/// 8-bit sRGB codes, three per pixel, of a display-referred image; rounded to nearest.
std::vector<std::uint8_t> encode_srgb8(Image const& display);

} // namespace abbe::image
