// SPDX-License-Identifier: MIT
#include "image/colour.hpp"

#include <cmath>
#include <glm/matrix.hpp>

namespace abbe::image {
namespace {

Mat3 const srgb_to_xyz = rgb_to_xyz_matrix(srgb_primaries);
Mat3 const xyz_to_srgb = glm::inverse(srgb_to_xyz);
Vec3 const white_xyz = srgb_to_xyz * Vec3(1);

constexpr double lab_limit = 216.0 / 24389.0; // (6/29)^3
constexpr double lab_kappa = 24389.0 / 27.0;  // (29/3)^3

double lab_curve(double t) {
  return t > lab_limit ? std::cbrt(t) : (lab_kappa * t + 16) / 116;
}

double lab_curve_inverse(double f) {
  double const cube = f * f * f;
  return cube > lab_limit ? cube : (116 * f - 16) / lab_kappa;
}

} // namespace

Mat3 rgb_to_xyz_matrix(Primaries const& primaries) {
  auto const to_xyz = [](Vec2 xy) { return Vec3(xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y); };
  // Blue may lie on y = 0 (XYZ as primaries), so columns are x, y, z and scaled by the white.
  auto const column = [](Vec2 xy) { return Vec3(xy.x, xy.y, 1 - xy.x - xy.y); };
  Mat3 const columns(column(primaries.red), column(primaries.green), column(primaries.blue));
  Vec3 const scale = glm::inverse(columns) * to_xyz(primaries.white);
  return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

Vec3 linear_srgb_to_xyz(Vec3 rgb) {
  return srgb_to_xyz * rgb;
}

Vec3 xyz_to_linear_srgb(Vec3 xyz) {
  return xyz_to_srgb * xyz;
}

double luminance(Vec3 rgb) {
  return srgb_to_xyz[0].y * rgb.x + srgb_to_xyz[1].y * rgb.y + srgb_to_xyz[2].y * rgb.z;
}

double srgb_encode(double linear) {
  double const v = std::abs(linear);
  double const code = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return std::copysign(code, linear);
}

double srgb_decode(double encoded) {
  double const v = std::abs(encoded);
  double const light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  return std::copysign(light, encoded);
}

Vec3 xyz_to_lab(Vec3 xyz) {
  double const fx = lab_curve(xyz.x / white_xyz.x);
  double const fy = lab_curve(xyz.y / white_xyz.y);
  double const fz = lab_curve(xyz.z / white_xyz.z);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Vec3 lab_to_xyz(Vec3 lab) {
  double const fy = (lab.x + 16) / 116;
  double const fx = fy + lab.y / 500;
  double const fz = fy - lab.z / 200;
  return {white_xyz.x * lab_curve_inverse(fx), white_xyz.y * lab_curve_inverse(fy),
          white_xyz.z * lab_curve_inverse(fz)};
}

Vec2 xyz_to_uv(Vec3 xyz) {
  double const sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
  return {4 * xyz.x / sum, 9 * xyz.y / sum};
}

} // namespace abbe::image
