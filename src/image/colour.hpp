// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "image/image.hpp"

/// Colour spaces of display-referred images. All of them are relative to D65 as sRGB defines it,
/// x, y = 0.3127, 0.3290, with Y = 1 for white: white gives L* = 100, a* = b* = 0.
/// @source IEC 61966-2-1 (sRGB), CIE 15:2004 (L*a*b*, u'v')
namespace abbe::image {

/// Chromaticities x, y of three primaries and their white.
struct Primaries {
  Vec2 red, green, blue, white;
};

inline constexpr Primaries srgb_primaries{
    {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Matrix from linear RGB of these primaries to XYZ with Y = 1 at (1, 1, 1).
/// @pre the primaries are not collinear
Mat3 rgb_to_xyz_matrix(Primaries const& primaries);

Vec3 linear_srgb_to_xyz(Vec3 rgb);
Vec3 xyz_to_linear_srgb(Vec3 xyz);
/// CIE Y of linear sRGB; 1 for white.
double luminance(Vec3 rgb);

/// The sRGB transfer function, linear light to code value; odd, so that differences may be encoded.
double srgb_encode(double linear);
/// Its inverse.
double srgb_decode(double encoded);

/// CIE 1976 L*, a*, b* of XYZ (white: Y = 1).
Vec3 xyz_to_lab(Vec3 xyz);
Vec3 lab_to_xyz(Vec3 lab);
/// CIE 1976 u', v'. Black (0, 0, 0) has none: NaN.
Vec2 xyz_to_uv(Vec3 xyz);

/// CIEDE2000 colour difference of two L*, a*, b*, with kL = kC = kH = 1.
/// @source Sharma, Wu, Dalal, "The CIEDE2000 Color-Difference Formula", Color Res. Appl. 30(1),
/// 2005
double ciede2000(Vec3 lab_1, Vec3 lab_2);

inline Vec3 pixel(Image const& image, std::size_t index) {
  float const* rgb = image.rgb.data() + 3 * index;
  return {rgb[0], rgb[1], rgb[2]};
}

inline void set_pixel(Image& image, std::size_t index, Vec3 rgb) {
  for (int c = 0; c < 3; ++c) image.rgb[3 * index + c] = static_cast<float>(rgb[c]);
}

} // namespace abbe::image
