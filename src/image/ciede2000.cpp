// SPDX-License-Identifier: MIT
#include "image/colour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::image {
namespace {

constexpr double degree = std::numbers::pi / 180;

double seventh_power_ratio(double chroma) {
  double const c7 = std::pow(chroma, 7);
  return std::sqrt(c7 / (c7 + 6103515625.0)); // 25^7
}

/// Degrees in [0, 360); 0 for grey.
double hue_deg(double a, double b) {
  if (a == 0 && b == 0) return 0;
  double const angle = std::atan2(b, a) / degree;
  return angle < 0 ? angle + 360 : angle;
}

} // namespace

// Equation numbers are those of Sharma, Wu, Dalal (2005).
double ciede2000(Vec3 lab_1, Vec3 lab_2) {
  double const c_mean = (std::hypot(lab_1.y, lab_1.z) + std::hypot(lab_2.y, lab_2.z)) / 2; // (3)
  double const g = 0.5 * (1 - seventh_power_ratio(c_mean));                                // (4)
  double const a_1 = (1 + g) * lab_1.y;
  double const a_2 = (1 + g) * lab_2.y;
  double const c_1 = std::hypot(a_1, lab_1.z);
  double const c_2 = std::hypot(a_2, lab_2.z);
  double const h_1 = hue_deg(a_1, lab_1.z);
  double const h_2 = hue_deg(a_2, lab_2.z);

  bool const grey = c_1 * c_2 == 0;
  double dh = 0; // (10)
  if (!grey) {
    dh = h_2 - h_1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
  }
  double const d_l = lab_2.x - lab_1.x;
  double const d_c = c_2 - c_1;
  double const d_h = 2 * std::sqrt(c_1 * c_2) * std::sin(dh / 2 * degree); // (11)

  double const l_mean = (lab_1.x + lab_2.x) / 2;
  double const cp_mean = (c_1 + c_2) / 2;
  double h_mean = h_1 + h_2; // (14)
  if (!grey) {
    if (std::abs(h_1 - h_2) > 180) h_mean += h_mean < 360 ? 360 : -360;
    h_mean /= 2;
  }
  double const t = 1 - 0.17 * std::cos((h_mean - 30) * degree)
                   + 0.24 * std::cos(2 * h_mean * degree)
                   + 0.32 * std::cos((3 * h_mean + 6) * degree)
                   - 0.20 * std::cos((4 * h_mean - 63) * degree); // (15)
  double const bump = (h_mean - 275) / 25;
  double const d_theta = 30 * std::exp(-bump * bump); // (16)
  double const r_c = 2 * seventh_power_ratio(cp_mean);
  double const l_50 = (l_mean - 50) * (l_mean - 50);
  double const s_l = 1 + 0.015 * l_50 / std::sqrt(20 + l_50);
  double const s_c = 1 + 0.045 * cp_mean;
  double const s_h = 1 + 0.015 * cp_mean * t;
  double const r_t = -std::sin(2 * d_theta * degree) * r_c;

  double const l = d_l / s_l;
  double const c = d_c / s_c;
  double const h = d_h / s_h;
  return std::sqrt(std::max(0.0, l * l + c * c + h * h + r_t * c * h)); // (22)
}

} // namespace abbe::image
