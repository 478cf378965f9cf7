// SPDX-License-Identifier: MIT
#include "simd/math.hpp"
#include "texture/warps/warps.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::texture {
namespace {

struct BlackHole final : Warp {
  Vec3 centre{0};
  double radius = 1, strength = 1, falloff = 2;
  bool inverse = false;
  Vec3 repeat{0};

  Vec3 apply(Vec3 const& point) const override {
    Vec3 middle = centre;
    for (int k = 0; k < 3; ++k)
      if (repeat[k] != 0) middle[k] += std::floor(point[k] / repeat[k]) * repeat[k];
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
    Span const at = in.next_span();
    if (in.accept("strength")) {
      warp->strength = in.number("strength");
    } else if (in.accept("falloff")) {
      warp->falloff = in.number("falloff");
    } else if (in.accept("inverse")) {
      warp->inverse = true;
    } else if (in.accept("repeat")) {
      warp->repeat = in.vec3("repeat");
    } else if (in.accept("turbulence")) {
      in.vec3("turbulence");
      in.report(Severity::Error, "E0901", "'turbulence' of a black hole is not supported yet", at);
    } else {
      break;
    }
  }
  return warp;
}

} // namespace abbe::texture
