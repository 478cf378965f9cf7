// SPDX-License-Identifier: MIT
#include "render/render.hpp"

#include "plan/working_space.hpp"
#include "render/each.hpp"
#include "render/frame.hpp"
#include "render/passes.hpp"

#include <utility>

namespace abbe::render {
namespace {

template <class Scene>
Stage make_stage(Scene&& scene, plan::Plan const& plan, RenderOptions const& options) {
  Stage stage = compile(std::forward<Scene>(scene), plan);
  if (options.max_trace_level) stage.max_trace_level = *options.max_trace_level;
  return stage;
}

template <class Scene>
RenderResult render_scene(Scene&& scene, plan::Plan const& plan, RenderOptions const& options) {
  ABBE_ASSERT(options.width > 0 && options.height > 0 && options.passes > 0);
  ABBE_ASSERT(!options.spectral_output || plan.spectral);
  ABBE_ASSERT(!options.rays_of_pixels || !options.checkpoint);
  ABBE_ASSERT(!options.passes_wanted || !options.checkpoint);
  plan::WorkingSpace const space(scene.settings);
  Stage const stage = make_stage(std::forward<Scene>(scene), plan, options);
  if (options.rays_of_pixels) {
    Region const region = options.pixels();
    options.rays_of_pixels->assign(
        static_cast<std::size_t>(region.x1 - region.x0) * (region.y1 - region.y0), 0);
  }
  if (options.passes == 1 && !options.passes_wanted) return make_frame(stage, options, space);
  return make_passes(stage, options, space);
}

} // namespace

RenderResult render(scene::Scene const& scene, plan::Plan const& plan,
                    RenderOptions const& options) {
  return render_scene(scene, plan, options);
}

RenderResult render(scene::Scene&& scene, plan::Plan const& plan, RenderOptions const& options) {
  return render_scene(std::move(scene), plan, options);
}

std::vector<RenderResult> render_regions(scene::Scene const& scene, plan::Plan const& plan,
                                         RenderOptions options,
                                         std::vector<Region> const& regions) {
  Stage const stage = make_stage(scene, plan, options);
  plan::WorkingSpace const space(scene.settings);
  std::vector<RenderResult> results;
  results.resize(regions.size());
  int const cores = cores_of(options);
  options.threads = 1; // of each region
  if (options.tile_size == 0) options.tile_size = usual_tile;
  for_each(0, static_cast<int>(regions.size()), cores, [&](int i) {
    auto const at = static_cast<std::size_t>(i);
    auto one = options;
    one.region = regions[at];
    results[at] = make_frame(stage, one, space);
  });
  return results;
}

} // namespace abbe::render
