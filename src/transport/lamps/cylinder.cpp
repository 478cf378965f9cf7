// SPDX-License-Identifier: MIT
#include "transport/lamps/cylinder.hpp"

#include "simd/math.hpp"

namespace abbe::transport {

void CylinderLamp::find_ways(Vectors const& points, std::size_t count, Aim& out) const {
  ParallelLamp::find_ways(points, count, out);
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 const way = points.get(k) - position_;
    out.across[k] = glm::length(way - direction_ * glm::dot(way, direction_));
  }
}

double CylinderLamp::share(Aim const& aim, std::size_t ray) const {
  double const across = aim.across[ray];
  if (aim.distance[ray] <= 0 || !(across < falloff_)) return 0;
  double const strength = tightness_ != 0 ? simd::pow(1 - across / falloff_, tightness_) : 1;
  if (across <= radius_) return strength;
  double const x = (falloff_ - across) / (falloff_ - radius_);
  return strength * (x * x * (3 - 2 * x));
}

} // namespace abbe::transport
