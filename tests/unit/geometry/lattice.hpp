// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scene.hpp"

/// Random shapes with many faces in common.
namespace abbe::geometry::test {

enum class Mix { Planes, Bounded, All };

inline PlacedShape any_shape(Dice& dice, Mix mix, double size) {
  // A lattice, so that many faces coincide.
  auto const step = [&] { return size * (dice.below(5) - 2) * 0.5; };
  Vec3 const at(step(), step(), step());
  int const kind =
      mix == Mix::Planes ? 0 : dice.below(mix == Mix::All ? 4 : 3) + (mix == Mix::All ? 0 : 1);
  if (kind == 0) {
    Vec3 const axis[3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    Vec3 const normal = dice.below(2) == 0 ? axis[dice.below(3)] : dice.direction();
    return *make_plane(normal, size * (0.5 + 0.5 * dice.below(3)));
  }
  if (kind == 1) return *make_box(at - Vec3(size), at + Vec3(size));
  if (kind == 2) return *make_sphere(at, size * (1 + 0.5 * dice.below(2)));
  return *make_cylinder(at - Vec3(0, size, 0), at + Vec3(0, size, 0), size, dice.below(2) == 0);
}

} // namespace abbe::geometry::test
