// SPDX-License-Identifier: MIT
#pragma once

#include "render/shade_lanes.hpp"
#include "render/tracer.hpp"

namespace abbe::render {

/// The ways from the hits of a fan to each lamp, found together when the first ray asks.
class FanShadows {
public:
  /// @param normals unit, against the rays
  /// @param beam of the rays
  FanShadows(Tracer& tracer, FanRay const& fan, geometry::FanHits const& hits,
             geometry::FanVectors const& normals, InsideNode const* after, Tracer::Frame& frame,
             Beam const& beam);

  enum class Way : std::uint8_t {
    Unknown, ///< to be asked for this ray alone
    Free,
    Filtered, ///< some light is left
    Blocked
  };
  /// By ray. @param light one of the stage's, not shadowless
  Way const* ways(CompiledLight const& light);
  /// What is left of its light on a ray's way that is Filtered, a value a lane of the ray.
  double const* left(CompiledLight const& light, std::size_t lane) const;
  /// Of a light of the stage.
  Aim const& aim(CompiledLight const& light) { return aimed(light).aim; }

private:
  struct Ways {
    bool aimed = false, known = false;
    Aim aim;
    Way way[geometry::fan_width];
    double* left = nullptr; ///< by lane
  };
  /// Some of the rays on their way to a lamp, behind the same surfaces. Arrays are in the arena.
  struct Filtered {
    geometry::FanLines* lines;
    geometry::Departure const* from;
    InsideNode const* inside;
    double* rest;       ///< way to the lamp, by ray
    std::size_t* place; ///< in the fan, by ray
    Beam light;         ///< what is left
  };
  Ways& aimed(CompiledLight const& light);
  void find(Ways& out);
  /// Shader::filter_shadow for several rays, with the same bits.
  void filter(Filtered const& rays, geometry::FanHits& hits, Ways& out);
  /// For those that meet the same surfaces, which are in `frame`: goes on behind them.
  void filter_behind(Filtered const& rays, geometry::FanHits const& hits, Tracer::Frame& frame,
                     Ways& out);
  /// Nothing more is met.
  void arrive(Filtered const& rays, Ways& out);
  /// Room for `count` of the rays.
  Filtered take(Filtered const& like, std::size_t count);
  /// The rays that are wanted(k), in order. @param hits theirs; null: there are none to be copied
  template <class Wanted>
  Filtered some(Filtered const& rays, Wanted const& wanted, geometry::FanHits const* hits,
                geometry::FanHits* hits_out);

  Tracer& tracer_;
  FanRay const& fan_;
  geometry::FanHits const& hits_;
  geometry::FanVectors const& normals_;
  InsideNode const* after_;
  Tracer::Frame& frame_;
  Beam const& beam_;
  Ways* ways_; ///< by light
};

} // namespace abbe::render
