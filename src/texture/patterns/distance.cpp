// SPDX-License-Identifier: MIT
#include "texture/patterns/distance.hpp"

#include "texture/patterns/formula.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::texture {
namespace {

double centre_one(double distance) {
  return 1 - std::min(distance, 1.0);
}

double spherical(Vec3 const& p, PatternModifiers const&) {
  return centre_one(glm::length(p));
}

double cylindrical(Vec3 const& p, PatternModifiers const&) {
  return centre_one(std::sqrt(p.x * p.x + p.z * p.z));
}

double planar(Vec3 const& p, PatternModifiers const&) {
  return centre_one(std::abs(p.y));
}

double boxed(Vec3 const& p, PatternModifiers const&) {
  return centre_one(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
}

double onion(Vec3 const& p, PatternModifiers const&) {
  return std::fmod(glm::length(p), 1.0);
}

} // namespace

std::shared_ptr<Pattern const> read_spherical(Parameters&) {
  return make_formula({.raw = spherical});
}

std::shared_ptr<Pattern const> read_cylindrical(Parameters&) {
  return make_formula({.raw = cylindrical});
}

std::shared_ptr<Pattern const> read_planar(Parameters&) {
  return make_formula({.raw = planar});
}

std::shared_ptr<Pattern const> read_boxed(Parameters&) {
  return make_formula({.raw = boxed});
}

std::shared_ptr<Pattern const> read_onion(Parameters&) {
  return make_formula({.raw = onion});
}

} // namespace abbe::texture
