// SPDX-License-Identifier: MIT
#include "job/stats.hpp"

#include "image/atomic_file.hpp"
#include "image/io.hpp"

#include <array>
#include <nlohmann/json.hpp>

namespace abbe::job {
namespace {

struct Kind {
  char const* name;
  std::uint64_t render::RayCounts::*count;
};
constexpr std::array kinds{Kind{"camera", &render::RayCounts::camera},
                           Kind{"reflected", &render::RayCounts::reflected},
                           Kind{"refracted", &render::RayCounts::refracted},
                           Kind{"monochromatic", &render::RayCounts::monochromatic},
                           Kind{"shadow", &render::RayCounts::shadow}};

} // namespace

nlohmann::ordered_json rays_to_json(render::RayCounts const& counts) {
  nlohmann::ordered_json out;
  for (auto const& kind : kinds) out[kind.name] = counts.*kind.count;
  out["total"] = counts.total();
  return out;
}

render::RayCounts rays_from_json(nlohmann::json const& rays) {
  render::RayCounts counts;
  for (auto const& kind : kinds) counts.*kind.count = rays.at(kind.name);
  return counts;
}

image::Status write_stats(std::string const& path, Before const& before, plan::Plan const& plan,
                          render::RenderOptions const& options, Outcome const& outcome) {
  auto const& rays = outcome.result.counts;
  nlohmann::ordered_json const out{
      {"version", ABBE_VERSION},
      {"scene", before.scene},
      {"width", options.width},
      {"height", options.height},
      {"bands", plan.spectral ? plan.spectral->count() : 0},
      {"seed", options.seed},
      {"passes", outcome.result.passes},
      {"scene_s", {{"wall", before.wall_s}, {"cpu", before.cpu_s}}},
      {"render_s", {{"wall", outcome.wall_s}, {"cpu", outcome.cpu_s}}},
      {"rays", rays_to_json(rays)},
      {"splits", rays.splits},
      {"fan_out", rays.splits == 0 ? 0 : double(rays.monochromatic) / double(rays.splits)},
      {"missing_mean", outcome.result.missing_mean},
  };
  return image::write_text(path, out.dump(2) + "\n");
}

image::Status write_cost_map(std::string const& path, render::RenderOptions const& options,
                             Outcome const& outcome) {
  render::Region const region = options.pixels();
  image::Image map = image::make_image(region.x1 - region.x0, region.y1 - region.y0);
  for (std::size_t i = 0; i < map.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) map.rgb[3 * i + c] = outcome.rays_of_pixels[i];
  map.metadata = {{"Content", "rays per pixel"}};
  return image::write(map, path);
}

} // namespace abbe::job
