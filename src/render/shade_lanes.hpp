// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"
#include "render/stage.hpp"

#include <cstdint>

/// The arithmetic of shading, side by side: for the rays of a fan, or for one. Values a ray stand
/// in whole fours; what is computed of places that have no meaning is left unread.
namespace abbe::render {

/// The ways from surfaces to a lamp.
struct Aim {
  geometry::FanVectors direction; ///< unit
  alignas(64) double distance[geometry::fan_width];
  alignas(64) double cosine[geometry::fan_width]; ///< between the way and the normal
  std::uint64_t comes = 0;                        ///< a bit a ray: its light can come there
};
/// @param normals unit, of the surfaces as they are lit
void aim(CompiledLight const& light, geometry::FanVectors const& points,
         geometry::FanVectors const& normals, std::size_t count, Aim& out);

/// What a lamp of strength 1 does to surfaces, a value a ray.
struct LitSurface {
  alignas(64) double diffuse[geometry::fan_width];  ///< but for `brilliance`
  alignas(64) double mirrored[geometry::fan_width]; ///< cosine, of the mirrored ray to the way
  alignas(64) double half[geometry::fan_width]; ///< cosine, of the normal to what halves the two
};
struct LitQuery {
  Aim const* aim;
  geometry::FanVectors const* view; ///< directions of the rays, unit
  geometry::FanVectors const* normal;
  double const* opaque;
  double front, back;  ///< diffuse reflectance on the side of the ray, and on the other
  bool mirrored, half; ///< wanted
};
void light_surfaces(LitQuery const& query, std::size_t count, LitSurface& out);

/// Light of rays, `each` lanes a ray; and of what it is multiplied by, values a lane.
struct ShadedLanes {
  std::size_t rays, each;
  double const *throughput, *passed, *colour;
};
/// A value a channel: of each ray's lanes the same, with room for eight more, or of each lane its
/// own.
struct ChannelValues {
  double const* values;
  bool same;
};
/// What a lamp adds to them, but for shadows.
struct Gloss {
  ChannelValues light;
  double const *strength, *diffuse; ///< a value a ray; `strength` null: 1
  double const* shine;              ///< a value a ray; null: 0
  double const* tint;               ///< of shine by the colour, a value a ray; null: 0
  double const* left; ///< of the light behind what filters it, a value a lane; null: all
};
/// @param out a value a lane
void find_gloss(ShadedLanes const& lanes, Gloss const& gloss, double* out);

/// What surfaces add that shine by themselves. @param opaque a value a ray
void find_glow(ShadedLanes const& lanes, ChannelValues glow, double const* opaque, double* out);

} // namespace abbe::render
