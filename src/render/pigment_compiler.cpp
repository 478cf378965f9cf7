// SPDX-License-Identifier: MIT
#include "render/pigment_compiler.hpp"

#include "base/word_hash.hpp"
#include "optics/conductor.hpp"

#include <algorithm>
#include <bit>

namespace abbe::render {

std::size_t PigmentCompiler::PlainHash::operator()(Plain const& plain) const {
  WordHash hash;
  for (double const number : plain) // -0 and 0 are equal
    hash.add(std::bit_cast<std::uint64_t>(number + 0.0));
  return hash.value();
}

int PigmentCompiler::add_shared(std::shared_ptr<scene::Pigment const> const& pigment) {
  auto const found = shared_.find(pigment.get());
  if (found != shared_.end()) return found->second;
  int const number = add(*pigment);
  shared_.emplace(pigment.get(), number);
  return number;
}

int PigmentCompiler::add(scene::Pigment const& pigment) {
  if (pigment.pattern) {
    CompiledPigment out;
    out.pattern = pigment.pattern;
    out.opaque = true;
    for (auto const& entry : pigment.entries) {
      out.values.push_back(entry.value);
      out.entries.push_back(add_shared(entry.pigment));
      out.opaque = out.opaque && opaque(out.entries.back());
    }
    out_.push_back(std::move(out));
    return static_cast<int>(out_.size()) - 1;
  }
  // A million objects may wear the same plain colour.
  scene::Colour const& c = pigment.colour;
  Plain const key{c.rgb.x, c.rgb.y, c.rgb.z, c.filter, c.transmit};
  if (!c.spectrum) {
    auto const found = plain_.find(key);
    if (found != plain_.end()) return found->second;
  }
  CompiledPigment out;
  out.colour = colours_.pigment(c);
  out.opaque = c.transmit == 0 && (c.filter == 0 || out.colour.maximum == 0);
  out_.push_back(std::move(out));
  int const number = static_cast<int>(out_.size()) - 1;
  if (!c.spectrum) plain_.emplace(key, number);
  return number;
}

namespace {

CompiledReflection compile_reflection(scene::Reflection const& reflection, ColourCompiler& colours,
                                      std::optional<optics::ChannelSet> const& channels) {
  CompiledReflection out;
  out.minimum = colours.reflectance(reflection.minimum);
  out.maximum = colours.reflectance(reflection.maximum);
  out.fresnel = reflection.fresnel;
  out.falloff = reflection.falloff;
  out.exponent = 1 / reflection.exponent;
  out.metallic = reflection.metallic;
  if (reflection.metal) {
    for (int i = 0; i < channels->count(); ++i) {
      auto const index = reflection.metal->index(channels->lambda_nm(i));
      out.metal_n.push_back(index.n);
      out.metal_k.push_back(index.k);
    }
  }
  return out;
}

Channels product(Channels a, Channels const& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] *= b[i];
  return a;
}

} // namespace

CompiledFinish compile_finish(scene::Finish const& finish, scene::Settings const& settings,
                              ColourCompiler& colours) {
  CompiledFinish out;
  Channels ambient =
      product(colours.reflectance(finish.ambient), colours.light(settings.ambient_light));
  if (!is_black(ambient)) out.ambient = std::move(ambient);
  Channels emission = colours.light(finish.emission);
  if (!is_black(emission)) out.emission = std::move(emission);
  out.diffuse = finish.diffuse;
  out.diffuse_back = finish.diffuse_back;
  out.brilliance = finish.brilliance;
  out.phong = finish.phong;
  out.phong_size = finish.phong_size;
  out.specular = finish.specular;
  out.roughness = finish.roughness;
  out.metallic = finish.metallic;
  out.conserve_energy = finish.conserve_energy;
  if (finish.reflection)
    out.reflection = compile_reflection(*finish.reflection, colours, colours.spectral());
  return out;
}

} // namespace abbe::render
