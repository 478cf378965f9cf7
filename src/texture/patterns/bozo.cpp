// SPDX-License-Identifier: MIT
#include "texture/patterns/bozo.hpp"

#include "texture/patterns/formula.hpp"

namespace abbe::texture {
namespace {

constexpr Pattern::DefaultEntry steps[] = {{0.4, Vec3(1)},       {0.4, Vec3(0, 1, 0)},
                                           {0.6, Vec3(0, 1, 0)}, {0.6, Vec3(0, 0, 1)},
                                           {0.8, Vec3(0, 0, 1)}, {0.8, Vec3(1, 0, 0)}};

double spots(Vec3 const& p, PatternModifiers const& modifiers) {
  return noise(p, modifiers.noise_generator);
}

void bumps(Vec3 const& p, PatternModifiers const&, double amount, Vec3& normal) {
  normal += amount * vector_noise(p);
}

} // namespace

std::shared_ptr<Pattern const> read_bozo(Parameters&) {
  return make_formula({.raw = spots, .map = steps});
}

std::shared_ptr<Pattern const> read_spotted(Parameters&) {
  return make_formula({.raw = spots});
}

std::shared_ptr<Pattern const> read_bumps(Parameters&) {
  return make_formula({.raw = spots, .tilt = bumps});
}

} // namespace abbe::texture
