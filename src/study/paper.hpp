// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"
#include "study/study.hpp"

namespace abbe::study {

/// What the page about the paper is made from.
struct PaperOptions {
  std::string program; ///< /proc/self/exe
  std::string version;
  std::filesystem::path examples;        ///< the scenes
  std::filesystem::path folder;          ///< of paper.md and paper/
  std::vector<optics::GlassPtr> glasses; ///< figure 1
  optics::GlassPtr prism;                ///< figures 2 and 3: N-SF11
  int rounds = 5;                        ///< of the timing table
  std::atomic<bool> const* stop = nullptr;
  std::function<void(std::string const& now)> on_progress;
};

/// Writes paper.md with its figures: the figures and the timing table of Wilkie, Tobler,
/// Purgathofer, "Raytracing of Dispersion Effects in Transparent Materials", WSCG 2000, from this
/// program.
/// @error E0510 a file cannot be written, E0531 a render failed or was interrupted
image::Status write_paper(PaperOptions const& options);

/// The line drawings, SVG.
/// Index against wavelength, 380..780 nm where the glass is known.
std::string index_curves(std::vector<optics::GlassPtr> const& glasses);
/// One interface: what comes back stays one ray, what passes is split.
std::string split_at_interface(optics::Glass const& glass);
/// A ray through a prism of 60 degrees: 8 deterministic rays, and jittered ones.
std::string fan_through_prism(optics::Glass const& glass);

} // namespace abbe::study
