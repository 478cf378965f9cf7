// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "scene/scene.hpp"

#include <memory>
#include <optional>

/// Questions that a scene asks about its objects while it is read: trace(), inside(), min_extent(),
/// max_extent().
namespace abbe::lang {

/// An object as the geometry library sees it: one solid in the space that it was declared in.
class ObjectQuery {
public:
  static ObjectQuery of(scene::Object const& object);

  struct Hit {
    Vec3 point{0};
    Vec3 normal{0}; ///< unit, outward
  };
  /// The nearest surface from `start` on along `direction` (not zero).
  std::optional<Hit> trace(Vec3 const& start, Vec3 const& direction) const;
  bool inside(Vec3 const& point) const;
  /// Is it without shapes (an empty union, a sphere of radius 0)? Then it has no bounds.
  bool nothing() const { return nothing_; }
  /// Infinite objects reach 1e10 in each direction.
  geometry::Bounds bounds() const;

private:
  ObjectQuery(geometry::World world, bool nothing) : world_(std::move(world)), nothing_(nothing) {}
  geometry::World world_;
  bool nothing_;
};

} // namespace abbe::lang
