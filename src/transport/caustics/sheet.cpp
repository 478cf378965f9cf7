// SPDX-License-Identifier: MIT
#include "transport/caustics/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace abbe::transport::caustics {

std::pair<Vec3, Vec3> axes_across(Vec3 const& d) {
  Vec3 const least = std::abs(d.x) <= std::abs(d.y) && std::abs(d.x) <= std::abs(d.z)
                         ? Vec3(1, 0, 0)
                     : std::abs(d.y) <= std::abs(d.z) ? Vec3(0, 1, 0)
                                                      : Vec3(0, 0, 1);
  Vec3 const a = glm::normalize(glm::cross(d, least));
  return {a, glm::cross(d, a)};
}

void Sheet::set(std::array<std::array<BeamRay, 9>, 2> const& rays) {
  near = far = 0;
  Vec3 mean{0};
  for (BeamRay const& ray : rays[0]) mean += ray.direction;
  along = glm::normalize(mean);
  std::tie(across, up) = axes_across(along);
  middle = rays[0][4].origin;
  for (std::size_t k = 0; k < 18; ++k) {
    BeamRay const& ray = rays[k / 9][k % 9];
    double const ahead = glm::dot(ray.direction, along);
    double const sx = glm::dot(ray.direction, across) / ahead,
                 sy = glm::dot(ray.direction, up) / ahead;
    Vec3 const off = ray.origin - middle;
    double const t = glm::dot(off, along);
    near = std::min(near, t);
    far = std::max(far, t);
    x[k] = static_cast<float>(glm::dot(off, across) - t * sx);
    y[k] = static_cast<float>(glm::dot(off, up) - t * sy);
    slope_x[k] = static_cast<float>(sx);
    slope_y[k] = static_cast<float>(sy);
  }
}

bool Sheet::may_hold(Vec3 const& point, double& first, double& last) const {
  Vec3 const off = point - middle;
  auto const ahead = static_cast<float>(glm::dot(off, along));
  double begin = 0, end = 1;
  // Sides of the rectangle around the nodes, a share wider, as they move with the wavelength: the
  // place is inside where `at` is not below them all.
  auto const cut = [&](float low, float high) { // a linear function is to be above zero
    if (low >= 0 && high >= 0) return;
    if (low < 0 && high < 0) {
      end = -1;
      return;
    }
    double const zero = low / (static_cast<double>(low) - high);
    if (low < 0)
      begin = std::max(begin, zero);
    else
      end = std::min(end, zero);
  };
  auto const axis = [&](std::array<float, 18> const& at, std::array<float, 18> const& slope,
                        double place) {
    float least[2], most[2];
    for (std::size_t i = 0; i < 2; ++i) {
      least[i] = most[i] = at[9 * i] + ahead * slope[9 * i];
      for (std::size_t k = 9 * i + 1; k < 9 * i + 9; ++k) {
        float const value = at[k] + ahead * slope[k];
        least[i] = std::min(least[i], value);
        most[i] = std::max(most[i], value);
      }
      float const more = 0.25F * (most[i] - least[i]);
      least[i] -= more;
      most[i] += more;
    }
    auto const p = static_cast<float>(place);
    cut(p - least[0], p - least[1]);
    cut(most[0] - p, most[1] - p);
  };
  axis(x, slope_x, glm::dot(off, across));
  if (end >= begin) axis(y, slope_y, glm::dot(off, up));
  first = from + begin * (to - from);
  last = from + end * (to - from);
  return end >= begin;
}

} // namespace abbe::transport::caustics
