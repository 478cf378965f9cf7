// SPDX-License-Identifier: MIT
#include "texture/warps/warps.hpp"

namespace abbe::texture {
namespace {

struct Stirred final : Warp {
  Turbulence turbulence;
  Vec3 apply(Vec3 const& point) const override {
    return point + turbulence.amount * vector_turbulence(point, turbulence);
  }
};

} // namespace

std::shared_ptr<Warp const> read_turbulence_warp(Parameters& in) {
  auto warp = std::make_shared<Stirred>();
  PatternModifiers read;
  read.turbulence.emplace();
  read.turbulence->amount = in.vec3("turbulence");
  while (!in.at_end() && read_turbulence_item(in, read)) {
  }
  warp->turbulence = *read.turbulence;
  return warp;
}

} // namespace abbe::texture
