// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "scene/scene.hpp"
#include "surface/textures.hpp"
#include "transport/caustics/emission.hpp"
#include "transport/lamps/area.hpp"
#include "transport/lanes.hpp"

#include <memory>
#include <optional>

namespace abbe::transport {

/// The ways from surfaces to a lamp.
struct Aim {
  Vectors direction; ///< unit
  Values distance;
  Values cosine;    ///< between the way and the normal of the surface as it is lit
  Values across;    ///< from its axis, of lamps that ask for it
  RaySet comes = 0; ///< its light can come there
};

/// A lamp, which may have an Area. A new one: a file here, and a line in lamps.cpp.
class Lamp {
public:
  /// What all lamps have, as scene::Light says.
  struct Common {
    surface::Channels value; ///< of its light
    bool shadowless = false;
    double fade_distance = 0, fade_power = 0;
    std::shared_ptr<Area const> area; ///< null: it is a point
    /// It lights only through this; or null.
    std::shared_ptr<geometry::World const> gate;
    bool weakened_by_air = false;
    std::uint16_t group = 0; ///< of lights
    scene::LampThrows throws;
  };
  explicit Lamp(Common common) : common_(std::move(common)) {}
  virtual ~Lamp() = default;
  surface::Channels const& value() const { return common_.value; }
  bool shadowless() const { return common_.shadowless; }
  Area const* area() const { return common_.area.get(); }
  geometry::World const* gate() const { return common_.gate.get(); }
  bool weakened_by_air() const { return common_.weakened_by_air; }
  std::uint16_t group() const { return common_.group; }
  scene::LampThrows const& throws() const { return common_.throws; }
  /// Where its rays begin, where they can be followed.
  virtual std::optional<caustics::LampRays> rays() const { return std::nullopt; }
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
  /// Share of its light that goes to a ray's surface.
  virtual double share(Aim const&, std::size_t /*ray*/) const { return 1; }

private:
  bool fades() const { return common_.fade_power > 0 && common_.fade_distance != 0; }
  Common common_;
};

/// The lamp that the scene's is.
/// @param position relative to the camera
std::unique_ptr<Lamp const> make_lamp(scene::Light const& light, Vec3 const& position,
                                      Lamp::Common common);

} // namespace abbe::transport
