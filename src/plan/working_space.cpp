// SPDX-License-Identifier: MIT
#include "plan/working_space.hpp"

#include "image/colour.hpp"
#include "simd/math.hpp"
#include "simd/native.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::plan {
namespace {

namespace lane = simd;

/// Powers of numbers without their signs.
struct Powers {
  template <class L>
  static void run(double* values, std::size_t count, double exponent) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t at) {
      Lanes const value = lane::load<Lanes>(values + at);
      lane::store(values + at,
                  lane::with_sign(lane::pow(lane::abs(value), Lanes(exponent)), value));
    });
  }
};
simd::Native<Powers> const powers;

} // namespace

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

double WorkingSpace::shown(double value) const {
  double const inside = std::clamp(value, 0.0, 1.0);
  if (kind_ == Kind::Srgb) return inside;
  double const light = kind_ == Kind::Power ? simd::pow(inside, gamma_) : inside;
  // image::srgb_encode() with powers that are the same on all processors.
  return light <= 0.0031308 ? 12.92 * light : 1.055 * simd::pow(light, 1 / 2.4) - 0.055;
}

void WorkingSpace::to_linear(std::span<float> values) const {
  if (kind_ == Kind::Linear) return;
  if (kind_ == Kind::Srgb) {
    for (float& value : values) value = static_cast<float>(to_linear(static_cast<double>(value)));
    return;
  }
  constexpr std::size_t some = 256;
  double block[some] = {};
  for (; !values.empty();) {
    std::size_t const count = std::min(some, values.size());
    std::copy_n(values.begin(), count, block);
    powers(block, count, gamma_);
    std::transform(block, block + count, values.begin(),
                   [](double value) { return static_cast<float>(value); });
    values = values.subspan(count);
  }
}

} // namespace abbe::plan
