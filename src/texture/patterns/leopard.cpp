// SPDX-License-Identifier: MIT
#include "texture/patterns/leopard.hpp"

#include "simd/math.hpp"
#include "texture/patterns/formula.hpp"

#include <cmath>

namespace abbe::texture {
namespace {

double leopard(Vec3 const& p, PatternModifiers const&) {
  double const mean = (simd::sin(p.x) + simd::sin(p.y) + simd::sin(p.z)) / 3;
  return mean * mean;
}

} // namespace

std::shared_ptr<Pattern const> read_leopard(Parameters&) {
  return make_formula({.raw = leopard});
}

} // namespace abbe::texture
