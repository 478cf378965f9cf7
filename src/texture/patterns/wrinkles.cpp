// SPDX-License-Identifier: MIT
#include "texture/patterns/wrinkles.hpp"

#include "texture/patterns/formula.hpp"

#include <algorithm>

namespace abbe::texture {
namespace {

double wrinkles(Vec3 const& p, PatternModifiers const& modifiers) {
  int const generator = modifiers.noise_generator;
  double sum = 0;
  double scale = 1;
  for (int k = 0; k < 10; ++k, scale *= 2) {
    double const n = noise(p * scale, generator);
    sum += (generator == 1 ? n : std::clamp(2 * n - 0.5, 0.0, 1.0)) / scale;
  }
  return sum / 2;
}

void tilt(Vec3 const& p, PatternModifiers const&, double amount, Vec3& normal) {
  Vec3 sum(0);
  double scale = 1;
  for (int k = 0; k < 10; ++k, scale *= 2) sum += glm::abs(vector_noise(p * scale)) / scale;
  normal += amount * sum;
}

} // namespace

std::shared_ptr<Pattern const> read_wrinkles(Parameters&) {
  return make_formula({.raw = wrinkles, .tilt = tilt});
}

} // namespace abbe::texture
