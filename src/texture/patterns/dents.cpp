// SPDX-License-Identifier: MIT
#include "texture/patterns/dents.hpp"

#include "texture/patterns/formula.hpp"

namespace abbe::texture {
namespace {

double dents(Vec3 const& p, PatternModifiers const& modifiers) {
  double const n = noise(p, modifiers.noise_generator);
  return n * n * n;
}

void tilt(Vec3 const& p, PatternModifiers const& modifiers, double amount, Vec3& normal) {
  normal += amount * dents(p, modifiers) * vector_noise(p);
}

} // namespace

std::shared_ptr<Pattern const> read_dents(Parameters&) {
  return make_formula({.raw = dents, .tilt = tilt});
}

} // namespace abbe::texture
