// SPDX-License-Identifier: MIT
#include "render/finish_numbers.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

constexpr std::size_t looked_through = 8;

bool same(scene::Colour const& a, scene::Colour const& b) {
  return a.rgb == b.rgb && a.filter == b.filter && a.transmit == b.transmit
         && a.spectrum == b.spectrum;
}

bool same(scene::Reflection const& a, scene::Reflection const& b) {
  return same(a.minimum, b.minimum) && same(a.maximum, b.maximum) && a.fresnel == b.fresnel
         && a.falloff == b.falloff && a.exponent == b.exponent && a.metallic == b.metallic
         && a.metal == b.metal;
}

bool same(scene::Finish const& a, scene::Finish const& b) {
  if (&a == &b) return true;
  return same(a.ambient, b.ambient) && same(a.emission, b.emission) && a.diffuse == b.diffuse
         && a.diffuse_back == b.diffuse_back && a.brilliance == b.brilliance && a.phong == b.phong
         && a.phong_size == b.phong_size && a.specular == b.specular && a.roughness == b.roughness
         && a.metallic == b.metallic && a.reflection.has_value() == b.reflection.has_value()
         && (!a.reflection || same(*a.reflection, *b.reflection))
         && a.conserve_energy == b.conserve_energy && a.crand == b.crand && a.irid == b.irid
         && a.irid_thickness == b.irid_thickness && a.irid_turbulence == b.irid_turbulence;
}

} // namespace

int FinishNumbers::of(Shared<scene::Finish> const& finish, bool tilts) {
  std::size_t const oldest = known_.size() - std::min(known_.size(), looked_through);
  for (std::size_t i = known_.size(); i-- > oldest;)
    if (auto const& [known, tilting] = known_[i]; tilting == tilts && same(*known, *finish))
      return static_cast<int>(i);
  known_.emplace_back(finish, tilts);
  return static_cast<int>(known_.size()) - 1;
}

} // namespace abbe::render
