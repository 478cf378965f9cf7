// SPDX-License-Identifier: MIT
#include "render/shown_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::render {

double shown_error(Vec3 const& mean, Vec3 const& standard_error, plan::WorkingSpace const& space) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    if (!(standard_error[c] > 0)) continue;
    double const up = space.shown(mean[c] + standard_error[c]);
    double const down = space.shown(mean[c] - standard_error[c]);
    sum += 0.25 * (up - down) * (up - down);
  }
  return std::sqrt(sum / 3);
}

Vec3 missed(Vec3 const& contrast, int count) {
  double const n = count;
  return contrast / (std::numbers::sqrt3 * n * std::sqrt(n));
}

double tolerance(Samples const& samples, double rays) {
  constexpr double many_rays = 1024;
  return samples.error * std::min(1.0, std::sqrt(rays / many_rays));
}

} // namespace abbe::render
