// SPDX-License-Identifier: MIT
#include "render/pigment_compiler.hpp"

#include "base/word_hash.hpp"
#include "optics/conductor.hpp"

#include <algorithm>
#include <bit>

namespace abbe::render {

int PigmentCompiler::add_shared(std::shared_ptr<scene::Pigment const> const& pigment) {
  auto const found = shared_.find(pigment.get());
  if (found != shared_.end()) return found->second;
  int const number = add(*pigment);
  shared_.emplace(pigment.get(), number);
  return number;
}

int PigmentCompiler::add(scene::Pigment const& pigment) {
  if (!pigment.pattern) return add_plain(pigment.colour);
  CompiledPattern map;
  map.pattern = pigment.pattern;
  CompiledPigment out;
  if (pigment.pattern->pattern->has_colours()) {
    out.opaque = !pigment.pattern->pattern->lets_light_pass();
    make_colour_grid();
  }
  for (auto const& entry : pigment.entries) {
    map.values.push_back(entry.value);
    map.entries.push_back(add_shared(entry.pigment));
    out.opaque = out.opaque && opaque(map.entries.back());
  }
  out.pattern = static_cast<std::int32_t>(stage_.textures.patterns.size());
  stage_.textures.patterns.push_back(std::move(map));
  stage_.textures.pigments.push_back(out);
  return static_cast<int>(stage_.textures.pigments.size()) - 1;
}

void PigmentCompiler::make_colour_grid() {
  surface::Textures& textures = stage_.textures;
  constexpr int side = 17;
  if (!colours_.spectral() || textures.colour_grid_side != 0) return;
  textures.colour_grid_side = side;
  for (int r = 0; r < side; ++r)
    for (int g = 0; g < side; ++g)
      for (int b = 0; b < side; ++b) {
        Channels const value = colours_.reflectance({Vec3(r, g, b) / (side - 1.0), 0, 0, nullptr});
        textures.colour_grid.insert(textures.colour_grid.end(), value.begin(), value.end());
      }
}

int PigmentCompiler::add_plain(scene::Colour const& colour) {
  Channels const value = colours_.reflectance(colour);
  WordHash hash;
  auto const add = [&](double number) { // -0 and 0 are equal
    hash.add(std::bit_cast<std::uint64_t>(number + 0.0));
  };
  for (double const channel : value) add(channel);
  add(colour.filter);
  add(colour.transmit);
  auto const fresh = static_cast<std::uint32_t>(stage_.textures.pigments.size());
  auto const number = plain_.find_or_add(hash.value(), fresh, [&](std::uint32_t known) {
    CompiledPigment const& other = stage_.textures.pigments[known];
    return other.filter == colour.filter && other.transmit == colour.transmit
           && std::equal(value.begin(), value.end(), stage_.textures.colour(other));
  });
  if (number == fresh) {
    CompiledPigment out;
    out.filter = colour.filter;
    out.transmit = colour.transmit;
    out.colour = static_cast<std::uint32_t>(stage_.textures.colours.size() / value.size());
    out.opaque = colour.transmit == 0
                 && (colour.filter == 0 || *std::max_element(value.begin(), value.end()) == 0);
    stage_.textures.pigments.push_back(out);
    stage_.textures.colours.insert(stage_.textures.colours.end(), value.begin(), value.end());
  }
  return static_cast<int>(number);
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
  // Without bands it is not asked for: reflection is off then.
  if (reflection.metal && channels) {
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

/// What a thin film's colours go by, in micrometres: the wavelengths of the channels, or those that
/// the scene says for r, g and b.
Channels film_wavelengths(scene::Settings const& settings, ColourCompiler const& colours) {
  if (!colours.spectral())
    return {settings.irid_wavelength.x, settings.irid_wavelength.y, settings.irid_wavelength.z};
  Channels out;
  for (int i = 0; i < colours.channels(); ++i)
    out.push_back(colours.spectral()->lambda_nm(i) / 1000);
  return out;
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
  out.crand = finish.crand;
  out.irid = finish.irid;
  out.irid_thickness = finish.irid_thickness;
  out.irid_turbulence = finish.irid_turbulence;
  if (finish.irid != 0) out.irid_wavelength = film_wavelengths(settings, colours);
  if (finish.reflection)
    out.reflection = compile_reflection(*finish.reflection, colours, colours.spectral());
  return out;
}

} // namespace abbe::render
