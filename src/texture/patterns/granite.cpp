// SPDX-License-Identifier: MIT
#include "texture/patterns/granite.hpp"

#include "texture/patterns/formula.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::texture {
namespace {

double granite(Vec3 const& p, PatternModifiers const& modifiers) {
  int const generator = modifiers.noise_generator;
  double sum = 0;
  double scale = 1;
  for (int k = 0; k < 6; ++k, scale *= 2) {
    double const n = noise(p * (4 * scale), generator);
    sum += (generator == 1 ? std::abs(0.5 - n) : std::min(0.5, std::abs(1 - 2 * n))) / scale;
  }
  return sum;
}

} // namespace

std::shared_ptr<Pattern const> read_granite(Parameters&) {
  return make_formula({.raw = granite});
}

} // namespace abbe::texture
