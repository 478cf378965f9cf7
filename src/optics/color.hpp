// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

/// Linear sRGB and CIE 1931 XYZ. Both matrices follow exactly from the chromaticities of the
/// standard (not from its matrix rounded to four digits), so that rgb (1,1,1) is D65 white to
/// rounding.
/// @source IEC 61966-2-1: R (0.64, 0.33), G (0.30, 0.60), B (0.15, 0.06), white (0.3127, 0.3290)
namespace abbe::optics {

/// XYZ of linear sRGB (1,1,1), Y = 1: (0.950456, 1, 1.089058).
inline constexpr Vec3 srgb_white_xyz{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};

/// Columns are the XYZ of the three primaries.
Mat3 const& rgb_to_xyz_matrix();
Mat3 const& xyz_to_rgb_matrix();

inline Vec3 rgb_to_xyz(Vec3 const& rgb) {
  return rgb_to_xyz_matrix() * rgb;
}
inline Vec3 xyz_to_rgb(Vec3 const& xyz) {
  return xyz_to_rgb_matrix() * xyz;
}
/// Y of a linear sRGB colour.
double luminance(Vec3 const& rgb);

} // namespace abbe::optics
