// SPDX-License-Identifier: MIT
#include "transport/lamps/spot.hpp"

#include "simd/math.hpp"

namespace abbe::transport {

double SpotLamp::share(Aim const& aim, std::size_t ray) const {
  double const cosine = -glm::dot(aim.direction.get(ray), direction_);
  if (cosine <= 0 || cosine < cos_falloff_) return 0;
  double const strength = tightness_ != 0 ? simd::pow(cosine, tightness_) : 1;
  if (!(cosine < cos_radius_)) return strength;
  double const x = (cosine - cos_falloff_) / (cos_radius_ - cos_falloff_);
  return strength * (x * x * (3 - 2 * x));
}

} // namespace abbe::transport
