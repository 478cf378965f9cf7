// SPDX-License-Identifier: MIT
#include "transport/lamps/spot.hpp"

#include "simd/math.hpp"

namespace abbe::transport {

double SpotLamp::towards(Vec3 const& to_lamp) const {
  double const cosine = -glm::dot(to_lamp, direction_);
  if (cosine <= 0 || cosine < cos_falloff_) return 0;
  double const strength = tightness_ != 0 ? simd::pow(cosine, tightness_) : 1;
  if (!(cosine < cos_radius_)) return strength;
  double const x = (cosine - cos_falloff_) / (cos_radius_ - cos_falloff_);
  return strength * (x * x * (3 - 2 * x));
}

} // namespace abbe::transport
