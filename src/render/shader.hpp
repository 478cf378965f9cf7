// SPDX-License-Identifier: MIT
#pragma once

#include "render/interface.hpp"
#include "render/pigment.hpp"
#include "render/tracer.hpp"

namespace abbe::render {

/// The textures of the surfaces at one hit: adds their own light, and says what they pass and
/// mirror. Formulas: POV-Ray's (language notes, section 14).
/// @tparam Lanes of the beam: compiled apart for one wavelength and for r g b; 0: any number
template <int Lanes>
class Shader {
public:
  Shader(Tracer& tracer, PathRay const& ray, Beam const& beam, Tracer::Frame& frame,
         LaneInterface const& face, InsideNode const* inside_after, FanShadows* shadows = nullptr,
         std::size_t lane = 0);

  /// All surfaces of the hit, nearest side first.
  LaneSurface shade();

private:
  /// Constant where it can be: the loops over lanes are most of the work.
  int lanes() const {
    if constexpr (Lanes > 0)
      return Lanes;
    else
      return beam_.lanes;
  }
  double* take_lanes() { return tracer_.arena_.take<double>(static_cast<std::size_t>(lanes())); }
  double* take_lanes(double value) {
    double* const values = take_lanes();
    for (int k = 0; k < lanes(); ++k) values[k] = value;
    return values;
  }
  bool any_left(double const* values) const {
    for (int k = 0; k < lanes(); ++k)
      if (values[k] > 0) return true;
    return false;
  }
  void shade_surface(geometry::SurfaceCrossing const& crossing, LaneSurface& out);
  void shade_layers(std::vector<int> const& layers, bool double_illuminate, bool carries,
                    LaneSurface& out);
  void shade_layer(CompiledLayer const& layer, bool double_illuminate, bool carries,
                   LaneSurface& out);
  PigmentValue pigment_at(CompiledLayer const& layer, Vec3 const& world_point);
  void add_glow(CompiledFinish const& finish, double const* pigment, double opaque,
                double const* passed);
  void add_lights(CompiledFinish const& finish, double const* pigment, double opaque,
                  bool double_illuminate, double const* passed);
  void add_light(CompiledLight const& light, CompiledFinish const& finish, double const* pigment,
                 double opaque, bool double_illuminate, double const* passed);
  void reflectivity(CompiledReflection const& reflection, double const* pigment, bool carries,
                    double* out);
  /// Light left after the way to a lamp; false when there is none. `left` is per lane.
  bool visible(CompiledLight const& light, Vec3 const& to_light, double distance, double* left);
  void filter_shadow(Vec3 const& to_light, double distance, double* left);

  Tracer& tracer_;
  Stage const& stage_;
  PathRay const& ray_;
  Beam const& beam_;
  Tracer::Frame& frame_;
  LaneInterface const& face_;
  InsideNode const* inside_after_;
  FanShadows* shadows_; ///< where the ray is one of a fan: lane_
  std::size_t lane_;
};

/// The unit direction from a point to a lamp, and how far it is; false where its light cannot come.
bool towards(CompiledLight const& light, Vec3 const& point, Vec3& direction, double& distance);

/// Attenuation by `fade_distance` and `fade_power` of the medium that is left, one channel.
double distance_fade(Medium const& medium, int channel, double distance);

} // namespace abbe::render
