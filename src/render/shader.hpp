// SPDX-License-Identifier: MIT
#pragma once

#include "render/interface.hpp"
#include "render/shade_lanes.hpp"
#include "render/tracer.hpp"
#include "surface/pigment.hpp"

namespace abbe::render {

/// Rays that met the same surfaces: one ray, and all surfaces of its hit, or a fan and the one that
/// it met. Arrays have a value a ray; `reflectance` one a lane, the first ray's lanes first.
struct Meeting {
  std::size_t rays = 1;
  geometry::FanVectors const* direction = nullptr; ///< unit, of the rays
  geometry::FanVectors const* point = nullptr;
  geometry::FanVectors const* point_error = nullptr;
  geometry::FanVectors const* normal = nullptr; ///< unit, of the surface as it is lit
  geometry::FanVectors const* geometric = nullptr;
  double const* cos_i = nullptr;
  double const* reflectance = nullptr; ///< Fresnel's
  std::size_t carrier = 0;             ///< LaneInterface::carrier
};

/// The textures of the surfaces that rays met: adds their own light, and says what they pass and
/// mirror. Formulas: POV-Ray's (language notes, section 14).
/// @tparam Lanes of each ray: compiled apart for one wavelength and for r g b; 0: any number
template <int Lanes>
class Shader {
public:
  /// @param beam the light of all rays @param shadows of the fan, where there is one
  Shader(Tracer& tracer, Meeting const& met, Beam const& beam, Tracer::Frame& frame,
         InsideNode const* inside, InsideNode const* inside_after, FanShadows* shadows)
      : tracer_(tracer),
        stage_(tracer.stage_),
        met_(met),
        beam_(beam),
        each_(beam.lanes / static_cast<int>(met.rays)),
        in_order_(!beam.monochromatic() && beam.comb == no_comb),
        frame_(frame),
        inside_(inside),
        inside_after_(inside_after),
        shadows_(shadows) {}

  /// All surfaces of the hit, nearest side first.
  FanSurface shade();

private:
  /// Rays that are still of interest, a bit each.
  using Rays = std::uint64_t;
  /// A pigment where each ray met it.
  struct Pigments {
    double* colour = nullptr; ///< a value a lane
    double filter[geometry::fan_width], transmit[geometry::fan_width];
    double opaque[geometry::fan_width];
  };
  /// How a lamp lights each ray's surface.
  struct Lit {
    Aim const* aim;
    bool shines = false;  ///< it makes highlights
    bool weakens = false; ///< `strength` is not 1 everywhere
    double strength[geometry::fan_width], shine[geometry::fan_width];
    LitSurface surface;
  };

  /// Constant where it can be: the loops over lanes are most of the work.
  int each() const {
    if constexpr (Lanes > 0)
      return Lanes;
    else
      return each_;
  }
  template <class Visit>
  void each_ray(Rays rays, Visit&& visit) const {
    for (std::size_t r = 0; r < met_.rays; ++r)
      if ((rays >> r & 1) != 0) visit(r, static_cast<int>(r) * each());
  }
  /// work(k) for each lane of those rays, with r their number.
  template <class Visit>
  void each_lane(Rays rays, Visit&& visit) const {
    each_ray(rays, [&](std::size_t r, int first) {
      for (int k = first; k < first + each(); ++k) visit(r, k);
    });
  }
  /// Adds them to the film, of those rays.
  void add(Rays rays, double const* lanes) {
    double* const out = tracer_.out_;
    std::uint32_t const* const slot = beam_.slot;
    each_lane(rays, [&](std::size_t, int k) { out[slot[k]] += lanes[k]; });
  }
  /// Of the channels of all rays' lanes; `values` gives that of a channel.
  template <class Values>
  ChannelValues by_channel(Values const& values) {
    if (in_order_) {
      auto* const own = tracer_.arena_.template take<double>(static_cast<std::size_t>(each()) + 8);
      for (int c = 0; c < each(); ++c) own[c] = values(static_cast<std::uint16_t>(c));
      return {own, true};
    }
    double* const lanes = take_lanes();
    for (int k = 0; k < beam_.lanes; ++k) lanes[k] = values(beam_.channel[k]);
    return {lanes, false};
  }
  ShadedLanes lanes_of(double const* passed, Pigments const& pigment) const {
    return {met_.rays, static_cast<std::size_t>(each()), beam_.throughput, passed, pigment.colour};
  }
  double* take_lanes() {
    return tracer_.arena_.take<double>(static_cast<std::size_t>(beam_.lanes));
  }
  double* take_lanes(double value) {
    double* const values = take_lanes();
    for (int k = 0; k < beam_.lanes; ++k) values[k] = value;
    return values;
  }
  /// Those that have a lane above a threshold.
  Rays with_light(Rays rays, double const* values, double threshold) const {
    Rays left = 0;
    each_ray(rays, [&](std::size_t r, int first) {
      if (any_above(values + first, each(), threshold)) left |= Rays{1} << r;
    });
    return left;
  }

  void shade_surface(geometry::SurfaceCrossing const& crossing, Rays rays, FanSurface& out);
  void shade_layers(std::span<int const> layers, bool double_illuminate, bool carries, Rays rays,
                    FanSurface& out);
  void shade_layer(CompiledLayer const& layer, bool double_illuminate, bool carries, Rays rays,
                   FanSurface& out);
  void pigments_at(CompiledLayer const& layer, Rays rays, Pigments& out);
  void plain_pigments_at(CompiledPigment const& pigment, Rays rays, Pigments& out);
  void add_glow(CompiledFinish const& finish, Pigments const& pigment, Rays rays,
                double const* passed);
  void reflectivity(CompiledReflection const& reflection, double const* pigment, bool carries,
                    Rays rays, double* out);
  void add_mirror(CompiledReflection const& reflection, double const* mirror, bool carries,
                  Rays rays, FanSurface& out);

  // shader_lights.cpp
  void add_light(CompiledLight const& light, CompiledFinish const& finish, Pigments const& pigment,
                 bool double_illuminate, Rays rays, double const* passed);
  /// The rays whose surface it lights, but for shadows.
  Rays light_up(CompiledLight const& light, CompiledFinish const& finish, Pigments const& pigment,
                bool double_illuminate, Rays rays, Lit& out);
  void find_strengths(CompiledLight const& light, Rays rays, Lit& out);
  void find_highlights(CompiledFinish const& finish, bool double_illuminate, Rays rays, Lit& out);
  /// Those that are left after shadows. @param left a value a lane, 1 before; null: nothing filters
  Rays visible_of(CompiledLight const& light, Lit const& lit, Rays rays, double* left);
  /// The same for ray r alone. @param left of its lanes
  bool visible(Lit const& lit, std::size_t r, double* left);
  void filter_shadow(Vec3 const& to_light, double distance, std::size_t r, double* left);

  Tracer& tracer_;
  Stage const& stage_;
  Meeting const& met_;
  Beam const& beam_;
  int each_;
  bool in_order_; ///< each ray has a lane a channel
  Tracer::Frame& frame_;
  InsideNode const* inside_;
  InsideNode const* inside_after_;
  FanShadows* shadows_;
};

/// POV-Ray's "Fresnel" tint of metallic highlights, x = angle / 90 degrees.
double metallic_falloff(double cosine);

/// Attenuation by `fade_distance` and `fade_power` of the medium that is left, one channel.
double distance_fade(Medium const& medium, int channel, double distance);
/// The same for light on its way from a lamp: a fade_power of 0 or below takes none of it in
/// POV-Ray.
inline double shadow_fade(Medium const& medium, int channel, double distance) {
  return medium.fade_power > 0 ? distance_fade(medium, channel, distance) : 1;
}

} // namespace abbe::render
