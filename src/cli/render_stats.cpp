// SPDX-License-Identifier: MIT
#include "cli/render_stats.hpp"

#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "study/ray_counts_json.hpp"

#include <nlohmann/json.hpp>

namespace abbe::cli {

image::Status write_stats(std::string const& path, RenderStats const& stats, plan::Plan const& plan,
                          render::RenderOptions const& options,
                          render::RenderResult const& result) {
  auto const& rays = result.counts;
  nlohmann::ordered_json const out{
      {"version", ABBE_VERSION},
      {"scene", stats.scene},
      {"width", options.width},
      {"height", options.height},
      {"bands", plan.spectral ? plan.spectral->count() : 0},
      {"seed", options.seed},
      {"passes", result.passes},
      {"scene_s", {{"wall", stats.scene_wall_s}, {"cpu", stats.scene_cpu_s}}},
      {"render_s", {{"wall", stats.render_wall_s}, {"cpu", stats.render_cpu_s}}},
      {"rays", study::rays_to_json(rays)},
      {"splits", rays.splits},
      {"fan_out", rays.splits == 0 ? 0 : double(rays.monochromatic) / double(rays.splits)},
      {"missing_mean", result.missing_mean},
  };
  return image::write_text(path, out.dump(2) + "\n");
}

image::Status write_cost_map(std::string const& path, std::vector<float> const& rays, int width,
                             int height) {
  image::Image map = image::make_image(width, height);
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) map.rgb[3 * i + c] = rays[i];
  map.metadata = {{"Content", "rays per pixel"}};
  return image::write(map, path);
}

} // namespace abbe::cli
