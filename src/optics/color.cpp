// SPDX-License-Identifier: MIT
#include "optics/color.hpp"

#include <glm/matrix.hpp>

namespace abbe::optics {

Mat3 const& rgb_to_xyz_matrix() {
  static Mat3 const matrix = [] {
    auto const primary = [](double x, double y) { return Vec3(x / y, 1, (1 - x - y) / y); };
    Mat3 const primaries(primary(0.64, 0.33), primary(0.30, 0.60), primary(0.15, 0.06));
    Vec3 const amount = glm::inverse(primaries) * srgb_white_xyz;
    return Mat3(primaries[0] * amount[0], primaries[1] * amount[1], primaries[2] * amount[2]);
  }();
  return matrix;
}

Mat3 const& xyz_to_rgb_matrix() {
  static Mat3 const matrix = glm::inverse(rgb_to_xyz_matrix());
  return matrix;
}

double luminance(Vec3 const& rgb) {
  Mat3 const& m = rgb_to_xyz_matrix();
  return m[0][1] * rgb[0] + m[1][1] * rgb[1] + m[2][1] * rgb[2];
}

} // namespace abbe::optics
