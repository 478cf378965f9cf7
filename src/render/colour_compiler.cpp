// SPDX-License-Identifier: MIT
#include "render/colour_compiler.hpp"

#include "optics/spectrum.hpp"
#include "optics/uplift.hpp"

#include <algorithm>

namespace abbe::render {
bool is_black(Channels const& channels) {
  return std::all_of(channels.begin(), channels.end(), [](double v) { return v == 0; });
}

Channels ColourCompiler::uplifted(Vec3 const& written) {
  if (!bands_) return {written.x, written.y, written.z};
  Vec3 const rgb = space_.to_linear(written);
  if (rgb.x == rgb.y && rgb.y == rgb.z)
    return Channels(static_cast<std::size_t>(bands_->count()), rgb.x);
  auto const [place, fresh] = known_.try_emplace({rgb.x, rgb.y, rgb.z});
  if (fresh) place->second = optics::uplift(rgb, *bands_);
  return place->second;
}

Channels ColourCompiler::spectral(scene::Colour const& colour, Channels values) {
  if (colour.rgb == Vec3(1)) return values;
  Channels const factor = uplifted(colour.rgb);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factor[i];
  return values;
}

Channels ColourCompiler::reflectance(scene::Colour const& colour) {
  if (!colour.spectrum) return uplifted(colour.rgb);
  // The plan renders in bands as soon as a spectrum stands in the scene.
  ABBE_ASSERT(bands_);
  auto values = optics::reflectance_bands(*colour.spectrum, *bands_);
  ABBE_ASSERT(values);
  return spectral(colour, std::move(*values));
}

Channels ColourCompiler::light(scene::Colour const& colour) {
  if (!colour.spectrum) return uplifted(colour.rgb);
  ABBE_ASSERT(bands_);
  return spectral(colour, optics::light_bands(*colour.spectrum, *bands_));
}

CompiledColour ColourCompiler::pigment(scene::Colour const& colour) {
  CompiledColour out;
  out.value = reflectance(colour);
  out.filter = colour.filter;
  out.transmit = colour.transmit;
  out.maximum = *std::max_element(out.value.begin(), out.value.end());
  return out;
}

} // namespace abbe::render
