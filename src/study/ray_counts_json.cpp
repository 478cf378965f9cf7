// SPDX-License-Identifier: MIT
#include "study/ray_counts_json.hpp"

#include <array>
#include <nlohmann/json.hpp>

namespace abbe::study {
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

} // namespace abbe::study
