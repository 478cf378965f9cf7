// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"

#include <vector>

namespace abbe::transport::caustics {

/// Is a shape a half-space?
bool is_plane(geometry::Shape const& shape);
/// May the surface of such a one be in a box? Never says no where it is.
bool plane_may_be_in(geometry::World const& world, geometry::PrimitiveId plane, Vec3 const& low,
                     Vec3 const& high);

/// Where surfaces are that show light that falls on them.
class Receivers {
public:
  Receivers() = default;
  explicit Receivers(Stage const& stage);
  /// Around the finite ones; a few boxes at most.
  std::vector<geometry::Bounds> const& boxes() const { return boxes_; }
  /// Are some of them not finite?
  bool endless() const { return everywhere_ || !planes_.empty(); }
  /// May such a surface be in a box? Never says no where one is.
  bool may_be_in(Vec3 const& low, Vec3 const& high) const;

private:
  geometry::World const* world_ = nullptr;
  std::vector<geometry::Bounds> boxes_;
  std::vector<geometry::PrimitiveId> planes_;
  bool everywhere_ = false; ///< some have no bounds that are known here
};

} // namespace abbe::transport::caustics
