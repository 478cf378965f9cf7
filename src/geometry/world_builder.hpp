// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

namespace abbe::geometry {

/// Makes a World piece by piece: each shape is taken as it is made, and nothing of what it was made
/// from is kept.
class WorldBuilder {
public:
  WorldBuilder();
  ~WorldBuilder();

  /// How many are to come, so that nothing is moved.
  void reserve(std::size_t primitives, std::size_t solids);
  /// In coordinates relative to the camera. Numbers count from 0.
  PrimitiveId add(ShapePtr shape, Transform const& placement);
  /// Of primitives that were added.
  SolidId add(World::Solid const& solid);
  Shape const& shape(PrimitiveId) const;
  /// The world of all of these. @param contact as World's
  World finish(double contact) &&;

private:
  std::unique_ptr<World::Impl> impl_;
  std::vector<bool> joins_; ///< by solid
};

} // namespace abbe::geometry
