// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "surface/textures.hpp"
#include "transport/lanes.hpp"

#include <memory>

namespace abbe::transport {

/// The ways from surfaces to a lamp.
struct Aim {
  Vectors direction; ///< unit
  Values distance;
  Values cosine;    ///< between the way and the normal of the surface as it is lit
  RaySet comes = 0; ///< its light can come there
};

/// A lamp without extent. A new one: a file here, and a line in lamps.cpp.
class Lamp {
public:
  /// What all lamps have, as scene::Light says.
  struct Common {
    surface::Channels value; ///< of its light
    bool shadowless = false;
    double fade_distance = 0, fade_power = 0;
  };
  explicit Lamp(Common common) : common_(std::move(common)) {}
  virtual ~Lamp() = default;
  surface::Channels const& value() const { return common_.value; }
  bool shadowless() const { return common_.shadowless; }
  /// Light grows near it, to this much at most.
  double brightest_fade() const { return fades() ? 2 : 1; }

  /// @param normals unit, of the surfaces as they are lit
  void aim(Vectors const& points, Vectors const& normals, std::size_t count, Aim& out) const;
  /// What share of its light comes there, of the first `count` rays. @param out room for whole
  /// lanes
  /// @return false: all; then nothing is written
  bool strengths(Aim const& aim, RaySet rays, std::size_t count, double* out) const;

protected:
  /// Directions and distances. A distance that is not above zero has no shadows on it.
  virtual void find_ways(Vectors const& points, std::size_t count, Aim& out) const = 0;
  /// Is there light where the distance is 0?
  virtual bool lights_itself() const { return false; }
  /// Is its light the same in all directions?
  virtual bool even() const { return true; }
  /// Share of its light in a direction, unit, towards the lamp.
  virtual double towards(Vec3 const&) const { return 1; }

private:
  bool fades() const { return common_.fade_power > 0 && common_.fade_distance != 0; }
  Common common_;
};

/// The lamp that the scene's is.
/// @param position relative to the camera
std::unique_ptr<Lamp const> make_lamp(scene::Light const& light, Vec3 const& position,
                                      Lamp::Common common);

} // namespace abbe::transport
