// SPDX-License-Identifier: MIT
#include "texture/patterns/marble.hpp"

#include "texture/patterns/formula.hpp"

namespace abbe::texture {
namespace {

constexpr Pattern::DefaultEntry red_to_black[] = {
    {0, Vec3(0.9, 0.8, 0.8)}, {0.9, Vec3(0.9, 0.08, 0.08)}, {0.9, Vec3(0)}};

double marble(Vec3 const& p, PatternModifiers const& modifiers) {
  if (!modifiers.turbulence || modifiers.turbulence->amount.x == 0) return p.x;
  Turbulence const& t = *modifiers.turbulence;
  return p.x + t.amount.x * turbulence(p, t, modifiers.noise_generator);
}

} // namespace

std::shared_ptr<Pattern const> read_marble(Parameters&) {
  return make_formula({.raw = marble,
                       .default_wave = Wave::Triangle,
                       .uses_turbulence_itself = true,
                       .map = red_to_black});
}

} // namespace abbe::texture
