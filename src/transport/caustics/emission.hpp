// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "geometry/shape.hpp"

#include <optional>

namespace abbe::transport::caustics {

/// Where the light of a lamp begins, relative to the camera. What the lamp does to it (spots,
/// fading with the distance) is the lamp's own.
struct LampRays {
  bool parallel = false;
  Vec3 position{0};  ///< of the lamp, or of a point of the plane that parallel light comes from
  Vec3 direction{0}; ///< unit, of parallel light
};

/// A ball.
struct Ball {
  Vec3 centre{0};
  double radius = 0;
};

/// The rays of a lamp by two numbers from -1 to 1: on the faces of a cube around a lamp that is a
/// point, on a square across parallel light.
class Emission {
public:
  /// A place on it.
  struct Place {
    int face = 0;
    Vec2 u{0};
  };
  /// @param casters that parallel light is wanted on; not empty
  Emission(LampRays const& lamp, geometry::Bounds const& casters);

  bool parallel() const { return lamp_.parallel; }
  int faces() const { return lamp_.parallel ? 1 : 6; }
  Vec3 origin(Place const& at) const;
  /// Unit.
  Vec3 direction(Place const& at) const;
  /// What tells places apart across faces: the direction, or where parallel light begins, in
  /// halves of the square.
  Vec3 name(Place const& at) const;
  /// Solid angle, or area of parallel light, a unit of u squared.
  double density(Place const& at) const;
  /// May rays of a cell meet a ball? Never says no where they do.
  bool may_meet(int face, Vec2 const& low, Vec2 const& high, Ball const& ball) const;

private:
  LampRays lamp_;
  Vec3 centre_{0}, across_{0}, up_{0}; ///< of the square
  double half_ = 0;
};

} // namespace abbe::transport::caustics
