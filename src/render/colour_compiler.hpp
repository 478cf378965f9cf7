// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"
#include "render/stage.hpp"
#include "render/working_space.hpp"

#include <map>
#include <optional>
#include <tuple>

namespace abbe::render {

/// Colours of the scene as channel values: bands (rgb uplifted to smooth spectra) or r g b.
class ColourCompiler {
public:
  ColourCompiler(std::optional<optics::Bands> const& bands, WorkingSpace const& space)
      : bands_(bands), space_(space) {}

  std::optional<optics::Bands> const& bands() const { return bands_; }
  int channels() const { return bands_ ? bands_->count() : 3; }
  /// Share of light reflected or passed.
  Channels reflectance(scene::Colour const& colour);
  /// Light: rgb is a multiple of D65.
  Channels light(scene::Colour const& colour);
  CompiledColour pigment(scene::Colour const& colour);

private:
  Channels uplifted(Vec3 const& rgb);
  Channels spectral(scene::Colour const& colour, Channels values);

  std::optional<optics::Bands> bands_;
  WorkingSpace space_;
  std::map<std::tuple<double, double, double>, Channels> known_;
};

/// Is every channel zero?
bool is_black(Channels const& channels);

} // namespace abbe::render
