// SPDX-License-Identifier: MIT
#pragma once

#include "transport/lamps/lamp.hpp"

/// The arithmetic of shading, side by side.
namespace abbe::transport {

/// What a lamp of strength 1 does to surfaces, a value a ray.
struct LitSurface {
  Values diffuse;  ///< but for `brilliance`
  Values mirrored; ///< cosine, of the mirrored ray to the way
  Values half;     ///< cosine, of the normal to what halves the two
};
struct LitQuery {
  Aim const* aim;
  Vectors const* view; ///< directions of the rays, unit
  Vectors const* normal;
  double const* opaque;
  double front, back;  ///< diffuse reflectance on the side of the ray, and on the other
  bool mirrored, half; ///< wanted
};
void light_surfaces(LitQuery const& query, std::size_t count, LitSurface& out);

/// Raises each of them to a power. @param values those not above zero lose their meaning
void raise(Values& values, std::size_t count, double exponent);

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
};
/// @param out a value a lane
void find_gloss(ShadedLanes const& lanes, Gloss const& gloss, double* out);

/// What surfaces add that shine by themselves. @param opaque a value a ray
void find_glow(ShadedLanes const& lanes, ChannelValues glow, double const* opaque, double* out);

} // namespace abbe::transport
