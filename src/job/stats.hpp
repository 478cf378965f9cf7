// SPDX-License-Identifier: MIT
#pragma once

#include "job/job.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace abbe::job {

/// What was done before the job began.
struct Before {
  std::string scene;            ///< its name
  double wall_s = 0, cpu_s = 0; ///< to parse, evaluate and plan it
};

/// One JSON object: "version", "scene", "width", "height", "bands" (0: r g b), "seed", "passes",
/// "scene_s" and "render_s" ("wall", "cpu"), "rays" by kind and "total", "splits", "fan_out",
/// "missing_mean".
/// @error E0510 the file cannot be written
image::Status write_stats(std::string const& path, Before const& before, plan::Plan const& plan,
                          render::RenderOptions const& options, Outcome const& outcome);

/// Outcome::rays_of_pixels as a grey picture, by the extension of the path.
/// @error as image::write
image::Status write_cost_map(std::string const& path, render::RenderOptions const& options,
                             Outcome const& outcome);

/// Rays by kind and "total".
nlohmann::ordered_json rays_to_json(render::RayCounts const& counts);
/// "total" is not read: it is the sum. @throws nlohmann::json::exception what is not of that form
render::RayCounts rays_from_json(nlohmann::json const& rays);

} // namespace abbe::job
