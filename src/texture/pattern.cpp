// SPDX-License-Identifier: MIT
#include "texture/pattern.hpp"

#include "base/result.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

double shaped(double r, Wave wave, double poly_exponent) {
  switch (wave) {
  case Wave::Ramp:
    return r;
  case Wave::Triangle:
    return r < 0.5 ? 2 * r : 2 * (1 - r);
  case Wave::Sine:
    return 0.5 * (1 + simd::sin(2 * pi * r));
  case Wave::Scallop:
    return std::abs(simd::sin(pi * r));
  case Wave::Cubic:
    return r * r * (3 - 2 * r);
  case Wave::Poly:
    return simd::pow(r, poly_exponent);
  }
  return r;
}

} // namespace

std::span<Pattern::DefaultEntry const> Pattern::default_map() const {
  static DefaultEntry const black_to_white[] = {{0, Vec3(0)}, {1, Vec3(1)}};
  return black_to_white;
}

Vec3 PatternInstance::place(Vec3 const& point, Sight const* sight) const {
  Vec3 p = uv && sight != nullptr ? Vec3(sight->uv, 0.0) : point;
  for (auto step = mappings.rbegin(); step != mappings.rend(); ++step)
    p = step->warp ? step->warp->apply(p) : step->linear * p + step->offset;
  if (!modifiers.turbulence || pattern->uses_turbulence_itself()) return p;
  Turbulence const& t = *modifiers.turbulence;
  return t.amount == Vec3(0) ? p : p + t.amount * vector_turbulence(p, t);
}

double PatternInstance::value(Vec3 const& placed, Sight const* sight) const {
  double r = pattern->raw_on(placed, modifiers, sight);
  double const frequency = modifiers.frequency.value_or(pattern->default_frequency());
  // 1.00001 and not 1: POV-Ray's choice, which lets exactly 1 stay 1.
  if (frequency != 0) r = std::fmod(r * frequency + modifiers.phase, 1.00001);
  if (r < 0) r -= std::floor(r);
  return shaped(r, modifiers.wave.value_or(pattern->default_wave()), modifiers.poly_exponent);
}

MapPosition look_up(std::span<double const> ascending_values, double value) {
  ABBE_ASSERT(!ascending_values.empty());
  int const last = static_cast<int>(ascending_values.size()) - 1;
  if (value >= ascending_values[last]) return {last, last, 0};
  auto const at = std::lower_bound(ascending_values.begin(), ascending_values.end(), value);
  int const above = static_cast<int>(at - ascending_values.begin());
  // `above > last` happens for a NaN only.
  if (above == 0 || above > last) return {0, 0, 0};
  if (*at == value) return {above, above, 0};
  double const low = ascending_values[above - 1];
  return {above - 1, above, (value - low) / (*at - low)};
}

} // namespace abbe::texture
