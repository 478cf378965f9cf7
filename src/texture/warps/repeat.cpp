// SPDX-License-Identifier: MIT
#include "texture/warps/warps.hpp"

#include <cmath>

namespace abbe::texture {
namespace {

struct Repeat final : Warp {
  int axis = 0;
  double width = 1;
  Vec3 offset{0};
  bool flips[3] = {};

  Vec3 apply(Vec3 const& point) const override {
    Vec3 p = point;
    double const slice = std::floor(p[axis] / width);
    p[axis] -= slice * width;
    if (slice != 2 * std::floor(slice / 2))
      for (int k = 0; k < 3; ++k)
        if (flips[k]) p[k] = k == axis ? width - p[k] : -p[k];
    return p + slice * offset;
  }
};

} // namespace

std::shared_ptr<Warp const> read_repeat_warp(Parameters& in) {
  auto warp = std::make_shared<Repeat>();
  Span const at = in.next_span();
  Vec3 const widths = in.vec3("width of the slice");
  int axes = 0;
  for (int k = 0; k < 3; ++k) {
    if (widths[k] == 0) continue;
    ++axes;
    warp->axis = k;
    warp->width = std::abs(widths[k]);
  }
  while (!in.at_end()) {
    if (in.accept("offset")) {
      warp->offset = in.vec3("offset");
    } else if (in.accept("flip")) {
      Vec3 const flip = in.vec3("axes to flip");
      for (int k = 0; k < 3; ++k) warp->flips[k] = flip[k] != 0;
    } else {
      break;
    }
  }
  if (axes == 1) return warp;
  in.report(Severity::Error, "E0385",
            "repeat needs a width along exactly one axis, as in 'repeat 2*x'", at);
  return nullptr;
}

} // namespace abbe::texture
