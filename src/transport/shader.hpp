// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "surface/pigment.hpp"
#include "transport/chunk.hpp"
#include "transport/shade_lanes.hpp"
#include "transport/tilt.hpp"

namespace abbe::transport {

namespace caustics {
class CausticLights;
}

/// What layers mirror whose normals are not the chunk's.
struct OwnMirror {
  std::uint32_t number; ///< QueueKey::mirrored: of the layer's place, the same for every ray
  RaySet rays = 0;
  double* light; ///< a value a lane, to be added as it is
  Vectors way;   ///< directions
  Values exponent;
};

/// What the textures that rays met let through, mirror, and send to the rays by themselves. Arrays
/// have a value a lane.
struct SurfaceLight {
  double* passed = nullptr;
  double* mirrored = nullptr; ///< asked for by `reflection`, to be added as it is
  RaySet mirrors = 0;
  RaySet explicit_reflection = 0; ///< a `reflection` item was given: Fresnel does not come unasked
  Values exponent;                ///< of `reflection`; of rays in `mirrors`
  std::vector<OwnMirror*> own_mirrors; ///< empty as a rule
  double* own = nullptr;      ///< light that the surface adds, throughput included; null: none
  double** of_lamp = nullptr; ///< by lamp: what it adds but for shadows; null: nothing
  RaySet* lit = nullptr;      ///< by lamp: the rays whose surface it lights
};

/// What Fresnel's reflectance is to a texture.
struct LaneReflectance {
  double const* of_lane = nullptr; ///< a value a lane
  double const* of_ray = nullptr;  ///< else a value a ray
};

/// The textures of the surfaces that rays met. Formulas: POV-Ray's (language notes, section 14).
/// @tparam Lanes of each ray: compiled apart for one wavelength and for r g b; 0: any number
template <int Lanes>
class Shader {
public:
  /// @param aims room for one a lamp @param lit_by_lamps false: its light goes nowhere
  /// @param thrown on the chunk by casters of caustics; or null
  Shader(Stage const& stage, Arena& arena, std::vector<Aim>& aims, Chunk const& chunk,
         LaneReflectance reflectance, bool lit_by_lamps, caustics::CausticLights* thrown)
      : stage_(stage),
        arena_(arena),
        aims_(aims),
        chunk_(chunk),
        each_(chunk.each),
        in_order_(chunk.kind.in_order()),
        reflectance_(reflectance),
        lit_by_lamps_(lit_by_lamps),
        thrown_(thrown) {}

  /// All surfaces of the hit, nearest side first. Arrays are in the arena.
  SurfaceLight shade();

private:
  /// A pigment where each ray met it.
  struct Pigments {
    double* colour = nullptr; ///< a value a lane
    Values filter, transmit, opaque;
  };
  /// How a lamp lights each ray's surface.
  struct Lit {
    bool shines = false;  ///< it makes highlights
    bool weakens = false; ///< `strength` is not 1 everywhere
    Values strength, shine;
    LitSurface surface;
  };
  /// The layers that rays see: for all the same numbers, or each the one of its own.
  struct Layer {
    int number = 0;
    int const* own = nullptr; ///< a ray
    int of(std::size_t r) const { return own != nullptr ? own[r] : number; }
  };
  /// Light that comes from one direction.
  struct LampLight {
    Lamp const* lamp; ///< that weakens it; null: nothing does
    ChannelValues value;
  };
  struct Side {
    bool double_illuminate = false;
    /// Of several surfaces that coincide, the one that reflects by Fresnel.
    bool carries = true;
    std::uint32_t place = 0; ///< of layers: of the crossing and the texture on it
    geometry::SurfaceCrossing const* crossing = nullptr;
    surface::SeenLayers::Part const* const* parts = nullptr; ///< a ray; null: the whole surface
    LayerSpot spot(std::size_t r) const {
      return {parts != nullptr ? parts[r] : nullptr, crossing};
    }
  };
  /// Normals and what comes of them, of the layer that is shaded: the chunk's, or its own.
  struct Facing {
    Vectors const* normal;
    Values const* cos_i;
    LayerFace const* own; ///< null: the chunk's
  };

  /// Constant where it can be: the loops over lanes are most of the work.
  std::size_t each() const {
    if constexpr (Lanes > 0)
      return Lanes;
    else
      return each_;
  }
  /// work(k) for each lane of those rays, with r their number.
  template <class Visit>
  void each_lane(RaySet rays, Visit&& visit) const {
    each_of(rays, [&](std::size_t r) {
      for (std::size_t k = r * each(); k < (r + 1) * each(); ++k) visit(r, k);
    });
  }
  void add(RaySet rays, double const* lanes, double* out) const {
    each_lane(rays, [&](std::size_t, std::size_t k) { out[k] += lanes[k]; });
  }
  /// Of the channels of all rays' lanes; `values` gives that of a channel.
  template <class Of>
  ChannelValues by_channel(Of const& values) {
    if (in_order_) {
      auto* const own = arena_.take<double>(each() + 8);
      for (std::size_t c = 0; c < each(); ++c) own[c] = values(static_cast<std::uint16_t>(c));
      return {own, true};
    }
    double* const lanes = take_lanes();
    for (std::size_t k = 0; k < chunk_.lanes(); ++k) lanes[k] = values(chunk_.channels[k]);
    return {lanes, false};
  }
  LampLight light_of(Lamp const& lamp) {
    return {&lamp, by_channel([&](std::uint16_t c) { return lamp.value()[c]; })};
  }
  ShadedLanes lanes_of(double const* passed, Pigments const& pigment) const {
    return {chunk_.count, each(), chunk_.light, passed, pigment.colour};
  }
  double* take_lanes() { return arena_.take<double>(chunk_.count * each() + 8); }
  double* take_lanes(double value) {
    double* const values = take_lanes();
    std::fill_n(values, chunk_.count * each(), value);
    return values;
  }
  /// Those that have a lane above a threshold.
  RaySet with_light(RaySet rays, double const* values, double threshold) const {
    RaySet left = 0;
    each_of(rays, [&](std::size_t r) {
      if (any_above(values + r * each(), each(), threshold)) left |= RaySet{1} << r;
    });
    return left;
  }

  void shade_single(RaySet rays, SurfaceLight& out);
  void shade_crossing(geometry::SurfaceCrossing const& crossing, bool carries, std::uint32_t place,
                      RaySet rays, SurfaceLight& out);
  /// Where rays see layers of their own: textures of faces, of the inside of open shapes.
  void shade_seen(RaySet rays, Side const& side, SurfaceLight& out,
                  surface::SeenLayers const* seen);
  void shade_layers(std::span<int const> layers, Side const& side, RaySet rays, SurfaceLight& out);
  void shade_layer(Layer const& layer, Side const& side, RaySet rays, SurfaceLight& out);
  /// Fresnel's reflectance at another angle than the chunk's.
  double fresnel_of(std::size_t r, double cos_i) const;
  Facing facing(Layer const& layer, Side const& side, RaySet rays);
  void pigments_at(Layer const& layer, Side const& side, RaySet rays, Pigments& out);
  /// The same where all rays see one that is without a pattern. @return false: they do not
  bool same_pigment(Layer const& layer, RaySet rays, Pigments& out);
  void add_glow(surface::CompiledFinish const& finish, Pigments const& pigment, RaySet rays,
                SurfaceLight& out);
  void reflectivity(surface::CompiledReflection const& reflection, double const* pigment,
                    Facing const& facing, bool carries, RaySet rays, double* out);
  void add_mirror(surface::CompiledReflection const& reflection, double const* mirror, bool carries,
                  RaySet rays, SurfaceLight& out);
  /// The same of a layer whose normals are its own.
  void add_own_mirror(surface::CompiledReflection const& reflection, double const* mirror,
                      Side const& side, LayerFace const& face, RaySet rays, SurfaceLight& out);

  // shader_lamps.cpp
  /// Those whose group of lights the lamp belongs to.
  RaySet lit_by(std::size_t lamp, Side const& side, RaySet rays) const;
  /// What a lamp adds that shines from one place, but for shadows. @param out a value a lane
  /// @return rays whose surface it lights
  RaySet find_added(LampLight const& light, Aim const& aim, surface::CompiledFinish const& finish,
                    Pigments const& pigment, Facing const& facing, bool double_illuminate,
                    RaySet rays, SurfaceLight const& surface, double* out);
  /// The same as a mean over the places of an area. @param middle of it
  RaySet add_places(std::size_t number, Aim const& middle, surface::CompiledFinish const& finish,
                    Pigments const& pigment, Facing const& facing, bool double_illuminate,
                    RaySet rays, SurfaceLight const& surface, double* out);
  void add_lamp(std::size_t lamp, surface::CompiledFinish const& finish, Pigments const& pigment,
                Facing const& facing, bool double_illuminate, RaySet rays, SurfaceLight& out);
  /// What light adds that casters of caustics throw there.
  void add_thrown(surface::CompiledFinish const& finish, Pigments const& pigment,
                  Facing const& facing, Side const& side, RaySet rays, SurfaceLight& out);
  /// What a thin film on the surface makes of a lamp's light. @param light a value a lane
  void add_film(surface::CompiledFinish const& finish, Aim const& aim, Facing const& facing,
                RaySet rays, double* light);
  /// The rays whose surface it lights, but for shadows.
  RaySet light_up(Lamp const* lamp, Aim const& aim, Vectors const& normal,
                  surface::CompiledFinish const& finish, Pigments const& pigment,
                  bool double_illuminate, RaySet rays, Lit& out);
  void find_highlights(surface::CompiledFinish const& finish, Aim const& aim,
                       bool double_illuminate, RaySet rays, Lit& out);

  Stage const& stage_;
  Arena& arena_;
  std::vector<Aim>& aims_;
  Chunk const& chunk_;
  std::size_t each_;
  bool in_order_; ///< each ray has a lane a channel
  LaneReflectance reflectance_;
  bool lit_by_lamps_;
  caustics::CausticLights* thrown_;
};

/// Shader::shade(), as it suits the number of lanes.
SurfaceLight shade(Stage const& stage, Arena& arena, std::vector<Aim>& aims, Chunk const& chunk,
                   LaneReflectance reflectance, bool lit_by_lamps, caustics::CausticLights* thrown);

/// POV-Ray's "Fresnel" tint of metallic highlights, x = angle / 90 degrees.
double metallic_falloff(double cosine);

} // namespace abbe::transport
