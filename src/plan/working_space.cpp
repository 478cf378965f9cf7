// SPDX-License-Identifier: MIT
#include "plan/working_space.hpp"

#include "image/colour.hpp"
#include "simd/math.hpp"

#include <cmath>

namespace abbe::plan {

WorkingSpace::WorkingSpace(scene::Settings const& settings) {
  bool const display_values = !settings.assumed_gamma && settings.version < 3.7;
  if (settings.assumed_gamma_srgb || display_values) {
    kind_ = Kind::Srgb;
  } else if (settings.assumed_gamma.value_or(1) != 1) {
    kind_ = Kind::Power;
    gamma_ = *settings.assumed_gamma;
  }
}

double WorkingSpace::to_linear(double value) const {
  double const size = std::abs(value);
  switch (kind_) {
  case Kind::Linear:
    return value;
  case Kind::Power:
    return std::copysign(simd::pow(size, gamma_), value);
  case Kind::Srgb:
    return std::copysign(image::srgb_decode(size), value);
  }
  return value;
}

} // namespace abbe::plan
