// SPDX-License-Identifier: MIT
#pragma once

#include "optics/band_hats.hpp"
#include "optics/channel_set.hpp"
#include "plan/working_space.hpp"
#include "render/compile.hpp"

#include <map>
#include <optional>
#include <tuple>

namespace abbe::render {

/// Colours of the scene as channel values: bands (rgb uplifted to smooth spectra) or r g b.
class ColourCompiler {
public:
  ColourCompiler(std::optional<optics::ChannelSet> const& spectral,
                 plan::WorkingSpace const& space);

  std::optional<optics::ChannelSet> const& spectral() const { return spectral_; }
  int channels() const { return spectral_ ? spectral_->count() : 3; }
  /// Share of light reflected or passed.
  Channels reflectance(scene::Colour const& colour);
  /// Light: rgb is a multiple of D65.
  Channels light(scene::Colour const& colour);

private:
  /// What a colour is: light has no power in emission lines of its own.
  enum class Role { Light, Reflectance };
  Channels uplifted(Vec3 const& rgb, Role role);
  Channels from_bands(std::vector<double> const& values, Role role) const;
  Channels times_rgb(scene::Colour const& colour, Channels values);

  std::optional<optics::ChannelSet> spectral_;
  std::optional<optics::BandHats> hats_; ///< where there are lines
  plan::WorkingSpace space_;
  std::map<std::tuple<double, double, double>, std::vector<double>> known_; ///< on all bands
};

/// Is every channel zero?
bool is_black(Channels const& channels);

} // namespace abbe::render
