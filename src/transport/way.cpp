// SPDX-License-Identifier: MIT
#include "transport/way.hpp"

#include <algorithm>
#include <limits>

namespace abbe::transport {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where a line has left a box for good; infinite for one without bounds.
double exit_of(geometry::Bounds const& box, geometry::Ray const& line) {
  double exit = infinity;
  if (box.infinite) return exit;
  for (int i = 0; i < 3; ++i) {
    double const d = line.direction[i];
    if (d != 0) exit = std::min(exit, ((d > 0 ? box.high[i] : box.low[i]) - line.origin[i]) / d);
  }
  return exit;
}

} // namespace

Way::End Way::to_last_stop(geometry::Ray const& line, MediaStacks::Id stack, double distance,
                           double travelled, Passage passage) {
  bool const escapes = !(distance < infinity);
  double at = 0;
  for (;;) {
    bool any = false;
    geometry::SolidId left = 0;
    double end = distance;
    stacks_.each_solid(stack, [&](geometry::SolidId solid) {
      if (stage_.solids[solid].plain || (!escapes && !stage_.solids[solid].leaks)) return;
      double const exit = exit_of(stage_.world->bounds(solid), line);
      if (!(exit < end)) return;
      end = exit;
      left = solid;
      any = true;
    });
    double const part = std::max(end - at, 0.0);
    if (!any) return {stack, part};
    Medium const& medium = stage_.medium(stacks_.medium(stack));
    passage.distance = &part;
    along(medium, passage);
    MediaStacks::Id const rest = stacks_.without(stack, left);
    if (stacks_.medium(rest) != stacks_.medium(stack)) {
      double const way = travelled + part;
      passage.distance = &way;
      leave(medium, passage);
    }
    at = std::max(at, end);
    stack = rest;
  }
}

bool drop_displaced(Stage const& stage, MediaStacks const& stacks, MediaStacks::Id before,
                    MediaStacks::Id after, geometry::RayHit& hit, geometry::HitGroup* group) {
  if (before == MediaStacks::none || after == MediaStacks::none) return true;
  int const least = std::min(stacks.priority(before), stacks.priority(after));
  auto const displaced = [&](auto const& crossing) {
    CompiledSolid const& solid = stage.solids[crossing.solid];
    return crossing.toggles && solid.has_medium && solid.priority < least;
  };
  if (group == nullptr) return !displaced(hit);
  std::erase_if(group->crossings, displaced);
  if (group->crossings.empty()) return false;
  geometry::SurfaceCrossing const& shown = geometry::shown(group->crossings);
  hit.solid = shown.solid;
  hit.primitive = shown.primitive;
  hit.face = shown.face;
  hit.entering = shown.entering;
  hit.toggles = shown.toggles;
  return true;
}

} // namespace abbe::transport
