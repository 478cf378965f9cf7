// SPDX-License-Identifier: MIT
#include "transport/insides.hpp"

#include <algorithm>

namespace abbe::transport {

Insides::Insides(Stage const& stage, MediaStacks& stacks, geometry::Scratch& scratch)
    : stage_(stage), stacks_(stacks), scratch_(scratch) {
  for (geometry::SolidId solid = 0; solid < stage.solids.size(); ++solid)
    if (stage.solids[solid].counts() && !stage.solids[solid].sheet)
      bounds_.push_back(stage.world->bounds(solid));
}

MediaStacks::Id Insides::at(Vec3 const& point) {
  auto const in_bounds = [&](geometry::Bounds const& box) {
    return box.infinite
           || (box.low.x <= point.x && point.x <= box.high.x && box.low.y <= point.y
               && point.y <= box.high.y && box.low.z <= point.z && point.z <= box.high.z);
  };
  MediaStacks::Id stack = MediaStacks::none;
  if (std::none_of(bounds_.begin(), bounds_.end(), in_bounds)) return stack;
  solids_.clear();
  stage_.world->containing(point, scratch_, solids_);
  for (auto const solid : solids_)
    if (stage_.solids[solid].counts() && !stage_.solids[solid].sheet)
      stack = stacks_.stood_in(stack, solid);
  return stack;
}

} // namespace abbe::transport
