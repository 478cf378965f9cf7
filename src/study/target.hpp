// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <optional>
#include <string>

namespace abbe::study {

/// A setting that is wanted for its error or its time.
struct Target {
  double delta_e = 0;   ///< mean CIEDE2000 against the converged picture; 0: not asked for
  double seconds = 0;   ///< of the clock, for choosing and rendering; 0: not asked for
  bool keep_aa = false; ///< the user has said: not to be chosen
};

struct Choice {
  std::optional<int> bands;   ///< nothing: the scene is rendered in r g b
  std::string dispersion;     ///< the words of a mode; "": as it was
  std::string representation; ///< "", or "composite" where lights have lines
  render::AntiAliasing aa;
  int passes = 1; ///< about so many fit in the time
  double expected_delta_e = 0;
  double expected_s = 0; ///< of the clock
  bool reached = false;  ///< else: the nearest that there is
  int probes = 0;
  double probe_share = 0; ///< of the picture's pixels, that were looked at
  std::string text;       ///< "hero 4, 16 bands, aa 3 (threshold 0.1)"
};

/// Chooses mode, its parameter, number of bands and anti-aliasing by probing the scene: small
/// patches of the picture at its own size, spread evenly, and all of it when it is small; each
/// setting's patches are compared with patches of many samples and wavelengths, which are made
/// until two halves of them agree.
///
/// For an error, each mode (study/ways_table.cpp) is made finer from its cheapest setting on: of
/// the next steps (twice the bands, the parameter, anti-aliasing) the one that lowers the error
/// more for its rays, until the target is met; the last step is then halved until the error is
/// close to it. Of the modes the one with the fewest rays is taken: the same on any machine. For a
/// time, each mode's settings are compared by the error that they are expected to have after as
/// many passes (render/passes.hpp) as fit in it; one pass takes a quarter of it, where that can be.
/// @param overrides of the command line: bands and dispersion given there are kept
/// @param options size, threads, seed; anti_aliasing is kept with Target::keep_aa
/// @error as plan::make_plan
Result<Choice> choose_setting(scene::Scene const& scene, plan::Overrides const& overrides,
                              render::RenderOptions const& options, Target const& target);

} // namespace abbe::study
