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
  middle = rays[0][4].origin;
  auto const [a, b] = axes_across(along);
  // The first axis along the longest way across, at the end.
  double xx = 0, xy = 0, yy = 0;
  for (auto const& of_end : rays)
    for (BeamRay const& ray : of_end) {
      double const t =
          (length - glm::dot(ray.origin - middle, along)) / glm::dot(ray.direction, along);
      double const end = length / glm::dot(rays[0][4].direction, along);
      Vec3 const off = ray.origin + t * ray.direction - (middle + end * rays[0][4].direction);
      Vec2 const at(glm::dot(off, a), glm::dot(off, b));
      xx += at.x * at.x;
      xy += at.x * at.y;
      yy += at.y * at.y;
    }
  double const half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
  // Of the two expressions for the direction of the larger eigenvalue, the one that is not small.
  Vec2 const longest = half >= 0 ? Vec2(half + root, xy) : Vec2(xy, root - half);
  double const size = glm::length(longest);
  Vec2 const c = size > 0 ? longest / size : Vec2(1, 0);
  across = c.x * a + c.y * b;
  up = glm::cross(along, across);
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

} // namespace abbe::transport::caustics
