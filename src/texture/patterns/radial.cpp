// SPDX-License-Identifier: MIT
#include "texture/patterns/radial.hpp"

#include "simd/math.hpp"
#include "texture/patterns/formula.hpp"

#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr Pattern::DefaultEntry rainbow[] = {
    {0, Vec3(0, 1, 1)}, {0.333, Vec3(1, 1, 0)}, {0.666, Vec3(1, 0, 1)}, {1, Vec3(0, 1, 1)}};

double radial(Vec3 const& p, PatternModifiers const&) {
  if (p.x == 0 && p.z == 0) return 0.25;
  return 0.25 + (simd::atan2(p.x, p.z) + std::numbers::pi) / (2 * std::numbers::pi);
}

} // namespace

std::shared_ptr<Pattern const> read_radial(Parameters&) {
  return make_formula({.raw = radial, .map = rainbow});
}

} // namespace abbe::texture
