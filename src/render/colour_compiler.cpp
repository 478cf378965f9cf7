// SPDX-License-Identifier: MIT
#include "render/colour_compiler.hpp"

#include "optics/spectrum.hpp"
#include "optics/uplift.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {
bool is_black(Channels const& channels) {
  return std::all_of(channels.begin(), channels.end(), [](double v) { return v == 0; });
}

ColourCompiler::ColourCompiler(std::optional<optics::ChannelSet> const& spectral,
                               plan::WorkingSpace const& space)
    : spectral_(spectral), space_(space) {
  if (spectral_ && !spectral_->lines_nm.empty()) hats_.emplace(spectral_->bands);
}

Channels ColourCompiler::from_bands(std::vector<double> const& values, Role role) const {
  Channels out = spectral_->from_bands(values);
  if (role == Role::Reflectance)
    for (int c = spectral_->band_count(); c < spectral_->count(); ++c)
      out[static_cast<std::size_t>(c)] = hats_->gather(spectral_->lambda_nm(c), values);
  return out;
}

Channels ColourCompiler::uplifted(Vec3 const& written, Role role) {
  if (!spectral_) return {written.x, written.y, written.z};
  Vec3 const rgb = space_.to_linear(written);
  // What is not a number is no key, and is to be seen in the picture.
  if (std::isnan(rgb.x + rgb.y + rgb.z))
    return Channels(static_cast<std::size_t>(channels()), rgb.x + rgb.y + rgb.z);
  auto const [place, fresh] = known_.try_emplace({rgb.x, rgb.y, rgb.z});
  if (fresh) place->second = optics::uplift(rgb, spectral_->bands);
  return from_bands(place->second, role);
}

Channels ColourCompiler::times_rgb(scene::Colour const& colour, Channels values) {
  if (colour.rgb == Vec3(1)) return values;
  Channels const factor = uplifted(colour.rgb, Role::Reflectance);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factor[i];
  return values;
}

Channels ColourCompiler::reflectance(scene::Colour const& colour) {
  if (!colour.spectrum) return uplifted(colour.rgb, Role::Reflectance);
  // The plan renders in bands as soon as a spectrum stands in the scene.
  ABBE_ASSERT(spectral_);
  auto const on_bands = optics::reflectance_bands(*colour.spectrum, spectral_->bands);
  ABBE_ASSERT(on_bands);
  Channels values = from_bands(*on_bands, Role::Reflectance);
  for (int c = spectral_->band_count(); c < spectral_->count(); ++c)
    values[static_cast<std::size_t>(c)] = colour.spectrum->value(spectral_->lambda_nm(c));
  return times_rgb(colour, std::move(values));
}

Channels ColourCompiler::light(scene::Colour const& colour) {
  if (!colour.spectrum) return uplifted(colour.rgb, Role::Light);
  ABBE_ASSERT(spectral_);
  if (spectral_->lines_nm.empty())
    return times_rgb(
        colour, from_bands(optics::light_bands(*colour.spectrum, spectral_->bands), Role::Light));
  Channels values =
      from_bands(optics::light_beside_lines(*colour.spectrum, spectral_->bands), Role::Light);
  values.resize(static_cast<std::size_t>(spectral_->band_count()));
  auto const lines =
      optics::light_at_lines(*colour.spectrum, spectral_->bands, spectral_->lines_nm);
  values.insert(values.end(), lines.begin(), lines.end());
  return times_rgb(colour, std::move(values));
}

} // namespace abbe::render
