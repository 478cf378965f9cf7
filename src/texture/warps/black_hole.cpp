// SPDX-License-Identifier: MIT
#include "simd/math.hpp"
#include "texture/cell_point.hpp"
#include "texture/warps/warps.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::texture {
namespace {

struct BlackHole final : Warp {
  Vec3 centre{0};
  double radius = 1, strength = 1, falloff = 2;
  bool inverse = false;
  Vec3 repeat{0}, turbulence{0};

  Vec3 apply(Vec3 const& point) const override {
    Vec3 middle = centre, cell(0);
    for (int k = 0; k < 3; ++k)
      if (repeat[k] != 0) cell[k] = std::floor(point[k] / repeat[k]);
    middle += cell * repeat;
    if (turbulence != Vec3(0) && repeat != Vec3(0))
      middle += turbulence * cell_point(noise_tables(), cell_randoms(), cell);
    Vec3 const way = point - middle;
    double const length = glm::length(way);
    if (!(length < radius)) return point;
    double const share = std::min(1.0, simd::pow(1 - length / radius, falloff) * strength);
    return inverse ? point - share * way : point + share * way;
  }
};

} // namespace

std::shared_ptr<Warp const> read_black_hole_warp(Parameters& in) {
  auto warp = std::make_shared<BlackHole>();
  warp->centre = in.vec3("centre");
  warp->radius = in.number("radius");
  while (!in.at_end()) {
    if (in.accept("strength")) {
      warp->strength = in.number("strength");
    } else if (in.accept("falloff")) {
      warp->falloff = in.number("falloff");
    } else if (in.accept("inverse")) {
      warp->inverse = true;
    } else if (in.accept("repeat")) {
      warp->repeat = in.vec3("repeat");
    } else if (in.accept("turbulence")) {
      warp->turbulence = in.vec3("turbulence");
    } else {
      break;
    }
  }
  // As POV-Ray does, so that no ball is cut off.
  for (int k = 0; k < 3; ++k) {
    if (warp->repeat[k] == 0) continue;
    warp->centre[k] = std::max(warp->centre[k], warp->radius);
    warp->repeat[k] =
        std::max(warp->repeat[k], warp->centre[k] + warp->radius + warp->turbulence[k]);
  }
  return warp;
}

} // namespace abbe::texture
