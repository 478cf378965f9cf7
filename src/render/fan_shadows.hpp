// SPDX-License-Identifier: MIT
#pragma once

#include "render/tracer.hpp"

namespace abbe::render {

/// The ways from the hits of a fan to each lamp, found together when the first ray asks.
class FanShadows {
public:
  /// @param normals unit, against the rays
  FanShadows(Tracer& tracer, FanRay const& fan, geometry::FanHits const& hits,
             geometry::FanVectors const& normals, InsideNode const* after, Tracer::Frame& frame);

  enum class Way : std::uint8_t {
    Unknown, ///< something filters the light, or is at the lamp: to be asked for each ray
    Free,
    Blocked
  };
  /// @param light one of the stage's, not shadowless
  Way way(CompiledLight const& light, std::size_t lane);
  /// As towards() (shader.hpp), of a light of the stage.
  bool towards(CompiledLight const& light, std::size_t lane, Vec3& direction, double& distance);

private:
  struct Ways {
    bool aimed = false, known = false;
    bool comes[geometry::fan_width]; ///< the light can come
    geometry::FanVectors direction;  ///< to the lamp
    alignas(32) double distance[geometry::fan_width];
    Way way[geometry::fan_width];
  };
  Ways& aimed(CompiledLight const& light);
  void find(Ways& out);

  Tracer& tracer_;
  FanRay const& fan_;
  geometry::FanHits const& hits_;
  geometry::FanVectors const& normals_;
  InsideNode const* after_;
  Tracer::Frame& frame_;
  Ways* ways_; ///< by light
};

} // namespace abbe::render
