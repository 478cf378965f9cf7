// SPDX-License-Identifier: MIT
#pragma once

#include "transport/media_stacks.hpp"

#include <vector>

namespace abbe::transport {

/// What points are inside of: where rays begin that come from no surface.
class Insides {
public:
  Insides(Stage const& stage, MediaStacks& stacks, geometry::Scratch& scratch);
  MediaStacks::Id at(Vec3 const& point);

private:
  Stage const& stage_;
  MediaStacks& stacks_;
  geometry::Scratch& scratch_;
  std::vector<geometry::Bounds> bounds_; ///< of solids that a ray may start in
  std::vector<geometry::SolidId> solids_;
};

} // namespace abbe::transport
