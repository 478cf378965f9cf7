// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "cli/scene_arguments.hpp"
#include "render/render.hpp"
#include "study/target.hpp"

#include <optional>
#include <string>

namespace abbe::cli {

/// What `abbe render` was asked for.
struct RenderArguments {
  SceneArguments scene;
  std::string output;
  std::string anti_aliasing = "off";
  std::string samples; ///< "N" or "A..B"; empty: not given
  std::optional<double> samples_error;
  bool aa_given = false; ///< on the command line, by either method
  std::string region;
  render::RenderOptions options;
  std::string gamut = "auto";
  double exposure_ev = 0;
  bool half = false;
  bool alpha = false;
  std::string frames; ///< "A..B"; empty: one picture, without a number
  int first_frame = 0, last_frame = 0;
  study::Target target;
  std::string time_text;
  std::string stats, cost_map; ///< files; empty: not asked for
  bool checkpoint = false, no_checkpoint = false, resume = false;

  bool has_target() const { return target.delta_e > 0 || target.seconds > 0; }
};

void add_options(CommandLine& app, RenderArguments& arguments);

/// Options that do not go together, or not with the picture: says so. The exit status, 0: go on.
int check(RenderArguments const& arguments);
/// Takes over what the scene says about samples, where the command line does not. The exit status,
/// 0: go on.
int settle_samples(RenderArguments& arguments, scene::Settings const& settings);
/// Whether --passes is of use, and possible. The exit status, 0: go on.
int check_passes(RenderArguments const& arguments, plan::Plan const& plan);

/// Prints the error. @return status
int render_failed(Error const& error, int status);

} // namespace abbe::cli
