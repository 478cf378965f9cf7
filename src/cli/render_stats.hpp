// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "plan/plan.hpp"
#include "render/render.hpp"

#include <string>
#include <vector>

namespace abbe::cli {

/// What `abbe render --stats FILE` tells.
struct RenderStats {
  std::string scene;
  double scene_wall_s = 0, scene_cpu_s = 0;   ///< parse, evaluate, plan
  double render_wall_s = 0, render_cpu_s = 0; ///< make ready, trace, write
};

/// One JSON object: "version", "scene", "width", "height", "bands" (0: r g b), "seed", "passes",
/// "scene_s" and "render_s" ("wall", "cpu"), "rays" by kind and "total", "missing_mean".
/// @error E0510 the file cannot be written
image::Status write_stats(std::string const& path, RenderStats const& stats, plan::Plan const& plan,
                          render::RenderOptions const& options, render::RenderResult const& result);

/// Rays a pixel as a grey picture, by the extension of the path.
image::Status write_cost_map(std::string const& path, std::vector<float> const& rays, int width,
                             int height);

} // namespace abbe::cli
