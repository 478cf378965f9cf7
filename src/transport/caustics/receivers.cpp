// SPDX-License-Identifier: MIT
#include "transport/caustics/receivers.hpp"

#include <algorithm>

namespace abbe::transport::caustics {
namespace {

/// More of them than pay for a look at each.
constexpr std::size_t many = 64;

} // namespace

bool is_plane(geometry::Shape const& shape) {
  std::vector<geometry::HalfSpace> planes;
  shape.half_spaces(planes);
  return shape.bounds().infinite && shape.flat(0) && planes.size() == 1;
}

bool plane_may_be_in(geometry::World const& world, geometry::PrimitiveId plane, Vec3 const& low,
                     Vec3 const& high) {
  std::size_t inside = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 const at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                  (corner & 4) != 0 ? high.z : low.z);
    inside += world.inside(plane, at) ? 1 : 0;
  }
  return inside % 8 != 0;
}

Receivers::Receivers(Stage const& stage) : world_(stage.world.get()) {
  for (geometry::SolidId solid = 0; solid < stage.solids.size(); ++solid) {
    if (!stage.solid_receives[solid]) continue;
    geometry::Bounds const box = world_->bounds(solid);
    if (box.infinite) {
      auto const lone = world_->lone(solid);
      if (lone && is_plane(world_->shape(*lone)))
        planes_.push_back(*lone);
      else
        everywhere_ = true;
    } else if (!box.empty()) {
      boxes_.push_back(box);
    }
  }
  everywhere_ = everywhere_ || planes_.size() > many;
  if (boxes_.size() <= many) return;
  geometry::Bounds all = boxes_.front();
  for (auto const& box : boxes_) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  boxes_ = {all};
}

bool Receivers::may_be_in(Vec3 const& low, Vec3 const& high) const {
  if (everywhere_) return true;
  for (auto const& box : boxes_) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis)
      meets = meets && box.low[axis] <= high[axis] && low[axis] <= box.high[axis];
    if (meets) return true;
  }
  return std::ranges::any_of(planes_, [&](geometry::PrimitiveId plane) {
    return plane_may_be_in(*world_, plane, low, high);
  });
}

} // namespace abbe::transport::caustics
