// SPDX-License-Identifier: MIT
#pragma once

#include "render/interface.hpp"
#include "render/pigment.hpp"
#include "render/tracer.hpp"

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
    double strength[geometry::fan_width], diffuse[geometry::fan_width], shine[geometry::fan_width];
    double cosine[geometry::fan_width], distance[geometry::fan_width];
    geometry::FanVectors to_light;
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
  void shade_layers(std::vector<int> const& layers, bool double_illuminate, bool carries, Rays rays,
                    FanSurface& out);
  void shade_layer(CompiledLayer const& layer, bool double_illuminate, bool carries, Rays rays,
                   FanSurface& out);
  void pigments_at(CompiledLayer const& layer, Rays rays, Pigments& out);
  void add_glow(CompiledFinish const& finish, Pigments const& pigment, Rays rays,
                double const* passed);
  void reflectivity(CompiledReflection const& reflection, double const* pigment, bool carries,
                    Rays rays, double* out);

  // shader_lights.cpp
  void add_light(CompiledLight const& light, CompiledFinish const& finish, Pigments const& pigment,
                 bool double_illuminate, Rays rays, double const* passed);
  /// The rays whose surface it lights, but for shadows.
  Rays light_up(CompiledLight const& light, CompiledFinish const& finish, Pigments const& pigment,
                bool double_illuminate, Rays rays, Lit& out);
  /// Light left after the way to a lamp; false when there is none. @param left a value a lane of
  /// ray r
  bool visible(CompiledLight const& light, Lit const& lit, std::size_t r, double* left);
  void filter_shadow(Vec3 const& to_light, double distance, std::size_t r, double* left);

  Tracer& tracer_;
  Stage const& stage_;
  Meeting const& met_;
  Beam const& beam_;
  int each_;
  Tracer::Frame& frame_;
  InsideNode const* inside_;
  InsideNode const* inside_after_;
  FanShadows* shadows_;
};

/// POV-Ray's "Fresnel" tint of metallic highlights, x = angle / 90 degrees.
double metallic_falloff(double cosine);

/// The unit direction from a point to a lamp, and how far it is; false where its light cannot come.
bool towards(CompiledLight const& light, Vec3 const& point, Vec3& direction, double& distance);

/// Attenuation by `fade_distance` and `fade_power` of the medium that is left, one channel.
double distance_fade(Medium const& medium, int channel, double distance);

} // namespace abbe::render
