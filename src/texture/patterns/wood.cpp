// SPDX-License-Identifier: MIT
#include "texture/patterns/wood.hpp"

#include "simd/math.hpp"
#include "texture/patterns/formula.hpp"

#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr Pattern::DefaultEntry two_browns[] = {{0.6, Vec3(0.666, 0.312, 0.2)},
                                                {0.6, Vec3(0.4, 0.1333, 0.066)}};

double wood(Vec3 const& p, PatternModifiers const& modifiers) {
  double x = p.x;
  double y = p.y;
  if (modifiers.turbulence) {
    Turbulence const& t = *modifiers.turbulence;
    Vec3 const shake = vector_turbulence(p, t);
    x += simd::sin(2 * std::numbers::pi * (p.x + shake.x) * t.amount.x);
    y += simd::sin(2 * std::numbers::pi * (p.y + shake.y) * t.amount.y);
  }
  return std::sqrt(x * x + y * y);
}

} // namespace

std::shared_ptr<Pattern const> read_wood(Parameters&) {
  return make_formula({.raw = wood,
                       .default_wave = Wave::Triangle,
                       .uses_turbulence_itself = true,
                       .map = two_browns});
}

} // namespace abbe::texture
