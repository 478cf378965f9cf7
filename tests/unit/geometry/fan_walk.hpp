// SPDX-License-Identifier: MIT
#pragma once

#include "fan_check.hpp"
#include "scene.hpp"

#include <cmath>

namespace abbe::geometry::test {

/// Rays that were asked for, and what fans said of them.
struct WalkCounts {
  int rays = 0, single = 0, pairs = 0;
};

/// A fan on its way through a world of about `size`, on or back from what its first ray meets; all
/// of its rays are compared with what each meets alone.
inline void walk_fan(World const& world, double size, Dice& dice, WalkCounts& counts) {
  ScratchPtr const scratch = World::make_scratch();
  FanLines lines;
  lines.count = 1 + static_cast<std::size_t>(dice.below(fan_width));
  Vec3 const eye = dice.direction() * (6 * size);
  Vec3 target = dice.in_cube(size);
  // Some at points of the lattice: edges and corners.
  if (dice.below(3) == 0) {
    double const x = dice.below(3) - 1, y = dice.below(3) - 1, z = dice.below(3) - 1;
    target = size * Vec3(x, y, z);
  }
  double const spread = std::pow(10.0, -dice.number(0.5, 9));
  for (std::size_t k = 0; k < lines.count; ++k) {
    lines.origin.set(k, eye);
    lines.direction.set(k, glm::normalize(target - eye) + dice.in_cube(spread));
    lines.origin_error.set(k, Vec3(0));
  }
  Departure from;
  for (int depth = 0; depth < 4 && !testing::Test::HasFailure(); ++depth) {
    double t_max[fan_width];
    for (double& t : t_max) t = dice.number(0, 10) * size;
    counts.rays += static_cast<int>(lines.count);
    FanCounts const found = compare_fan(world, lines, depth > 0 ? &from : nullptr, t_max, *scratch);
    counts.single += found.single;
    counts.pairs += found.pairs;
    HitGroup hit;
    if (!world.closest(lines.get(0), depth > 0 ? &from : nullptr, 0xff, infinity, *scratch, hit))
      return;
    // On through the surface, or back from it, with directions that drift apart.
    bool const through = dice.below(3) != 0;
    Departure const next = leave(hit, through);
    Vec3 const normal =
        world.geometric_normal(hit.crossings[0].primitive, hit.crossings[0].face, hit.point);
    bool const to_inside = hit.members[0].was_entering == through;
    for (std::size_t k = 0; k < lines.count; ++k) {
      Vec3 d = lines.direction.get(0) + dice.in_cube(spread);
      if ((glm::dot(d, normal) < 0) != to_inside) d = d - 2 * glm::dot(d, normal) * normal;
      lines.origin.set(k, hit.point);
      lines.direction.set(k, d);
      lines.origin_error.set(k, hit.point_error);
    }
    from = next;
  }
}

} // namespace abbe::geometry::test
