// SPDX-License-Identifier: MIT
#include "render/fan_shadows.hpp"

#include "render/fan_interface.hpp"
#include "render/shader.hpp"

#include <algorithm>

namespace abbe::render {

FanShadows::FanShadows(Tracer& tracer, FanRay const& fan, geometry::FanHits const& hits,
                       geometry::FanVectors const& normals, InsideNode const* after,
                       Tracer::Frame& frame)
    : tracer_(tracer),
      fan_(fan),
      hits_(hits),
      normals_(normals),
      after_(after),
      frame_(frame),
      ways_(tracer.arena_.take<Ways>(tracer.stage_.lights.size())) {
  for (std::size_t i = 0; i < tracer.stage_.lights.size(); ++i)
    ways_[i].aimed = ways_[i].known = false;
}

FanShadows::Ways& FanShadows::aimed(CompiledLight const& light) {
  Ways& ways = ways_[&light - tracer_.stage_.lights.data()];
  if (ways.aimed) return ways;
  ways.aimed = true;
  std::size_t const n = fan_.lines->count;
  if (light.kind == scene::Light::Kind::Parallel) {
    for (std::size_t k = 0; k < n; ++k) {
      Vec3 direction;
      ways.comes[k] = render::towards(light, hits_.point.get(k), direction, ways.distance[k]);
      ways.direction.set(k, direction);
    }
    return ways;
  }
  aim_fan(hits_.point, n, light.position, ways.direction, ways.distance);
  for (std::size_t k = 0; k < n; ++k) ways.comes[k] = ways.distance[k] != 0;
  return ways;
}

bool FanShadows::towards(CompiledLight const& light, std::size_t lane, Vec3& direction,
                         double& distance) {
  Ways const& ways = aimed(light);
  direction = ways.direction.get(lane);
  distance = ways.distance[lane];
  return ways.comes[lane];
}

FanShadows::Way FanShadows::way(CompiledLight const& light, std::size_t lane) {
  Ways& ways = aimed(light);
  if (!ways.known) find(ways);
  return ways.way[lane];
}

void FanShadows::find(Ways& out) {
  out.known = true;
  std::size_t const n = fan_.lines->count;
  std::fill_n(out.way, n, Way::Unknown);
  Arena::Scope const scope(tracer_.arena_);
  auto* lines = tracer_.arena_.take<geometry::FanLines>(1);
  bool through = false;
  for (std::size_t k = 0; k < n; ++k) {
    if (!out.comes[k]) return;
    bool const beyond = glm::dot(normals_.get(k), out.direction.get(k)) < 0;
    if (k > 0 && beyond != through) return; // the lamp is in the surface's plane
    through = beyond;
  }
  lines->count = n;
  lines->origin.take(hits_.point, n);
  lines->origin_error.take(hits_.point_error, n);
  lines->direction.take(out.direction, n);
  lines->fill();
  double const* const to_lamp = out.distance;
  frame_.shadow.on = frame_.hit.members;
  frame_.shadow.through = through;
  Stage const& stage = tracer_.stage_;
  InsideNode const* const inside = through ? after_ : fan_.inside;
  bool blocked[geometry::fan_width], clear[geometry::fan_width];
  stage.world->occluded_fan(*lines, &frame_.shadow, opaque_shadow_bit, to_lamp, *tracer_.scratch_,
                            blocked, clear);
  bool const any_clear = std::any_of(clear, clear + n, [](bool is_clear) { return is_clear; });
  if (stage.has_filter_shadows && any_clear) {
    auto* hits = tracer_.arena_.take<geometry::FanHits>(1);
    stage.world->closest_fan(*lines, &frame_.shadow, filter_shadow_bit, to_lamp, *tracer_.scratch_,
                             *hits);
    for (std::size_t k = 0; k < n; ++k)
      clear[k] = clear[k] && !inside && hits->hit[k].kind == geometry::FanHit::Kind::Nothing;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (blocked[k]) out.way[k] = Way::Blocked;
    if (clear[k]) out.way[k] = Way::Free;
  }
}

} // namespace abbe::render
