// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "optics/channel_set.hpp"
#include "optics/comb.hpp"
#include "optics/glass.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "surface/reader.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// The scene made ready for rays: flattened, relative to the camera, every colour as one number a
/// channel. Immutable while rays are traced.
namespace abbe::render {

using surface::Channels, surface::CompiledFinish, surface::CompiledLayer, surface::CompiledPattern,
    surface::CompiledPigment, surface::CompiledReflection, surface::TextureSpace;
using surface::Surface, surface::SurfaceLayers, surface::Textures;

/// What a ray may travel in. Number 0 is the surrounding air.
struct Medium {
  double index_d = 1;  ///< the index where no wavelength is distinguished
  Channels index;      ///< per channel at the band's mean wavelength, where it disperses
  Channels flat_index; ///< index_d for every channel, where it does not
  Channels absorption; ///< per scene unit; empty: none
  optics::Glass const* glass = nullptr; ///< for wavelengths of combs
  bool dispersive = false;
  bool fresnel = false;    ///< a real dielectric (glass {}): its faces reflect by Fresnel unasked
  int comb = -1;           ///< number of its comb (stochastic modes)
  double tolerance_px = 0; ///< of the adaptive mode; 0: every lane goes its own way
  double fade_distance = 0, fade_power = 0;
  Channels fade_colour;
  double caustics = 0; ///< exponent / 45 of what a crossing adds to a lamp's light
  bool refracts() const { return dispersive || index_d != 1; }
};

struct CompiledSolid {
  int medium = 0;          ///< of its inside
  bool has_medium = false; ///< an interior was given: it counts as a medium
  int priority = 0;        ///< of the medium among those that overlap
  bool leaks = false;      ///< rays may enter it and not leave it: left at its bounds
  /// Its surface does not enclose it: a ray that crosses it, whichever way, leaves what it is
  /// inside of and enters what it is not inside of, as in POV-Ray.
  bool open = false;
  bool sheet = false; ///< no point is inside of it unless a ray has entered it
};

struct CompiledLight {
  scene::Light::Kind kind = scene::Light::Kind::Point;
  Vec3 position{0};        ///< relative to the camera
  Vec3 direction{0, 0, 1}; ///< unit, from the light, of spot and parallel lights
  Channels value;
  double cos_radius = 1, cos_falloff = 0, tightness = 0;
  bool shadowless = false;
  double fade_distance = 0, fade_power = 0;
};

/// World mask bits (geometry::visible_to_*): opaque and filtering casters of shadows apart.
inline constexpr std::uint8_t camera_bit = 1, reflection_bit = 2, opaque_shadow_bit = 4,
                              filter_shadow_bit = 8;

struct Stage {
  int channels = 3;
  std::optional<optics::ChannelSet> spectral; ///< nullopt: r g b
  std::unique_ptr<geometry::World> world;
  std::vector<CompiledSolid> solids; ///< by SolidId
  Textures textures;
  std::vector<Medium> media;                                 ///< [0] is air
  std::vector<std::shared_ptr<optics::Glass const>> glasses; ///< keeps Medium::glass alive
  std::vector<CompiledLight> lights;
  /// Light of different combs is kept apart on the film because the wavelengths that it stands for
  /// differ.
  std::vector<optics::Comb> combs;
  Channels background;
  std::vector<int> sky_pigments; ///< pigments; the last on top
  Channels sky_emission;
  Mat3 to_sky_linear{1};
  Vec3 to_sky_offset{0};
  scene::Camera camera; ///< location is the origin of the stage
  /// A ray with no lane above this throughput is dropped, and one below this
  /// level. What that takes away at most is summed up (CutLight).
  double adc_bailout = 1.0 / 255;
  int max_trace_level = 5;
  double brightest = 0; ///< no path returns more: bound of the radiance, any channel
  bool has_filter_shadows = false;
  bool has_priorities = false;    ///< some medium has another priority than 0
  bool has_leaks = false;         ///< some medium's solid leaks
  std::vector<Vec3> rgb_weights;  ///< colour of one unit of each channel
  std::vector<double> lambdas_nm; ///< of the channels, unless they are r g b

  surface::Reader reader() const { return {textures, *world}; }
  /// Of the interior that a surface is of.
  double caustics(geometry::SolidId solid) const {
    return media[static_cast<std::size_t>(solids[solid].medium)].caustics;
  }
  optics::Bands const& bands() const { return spectral->bands; }
  /// Of the spectral film.
  std::size_t film_bands() const {
    return spectral ? static_cast<std::size_t>(bands().count()) : 0;
  }
  double lambda_nm(int channel) const { return lambdas_nm[static_cast<std::size_t>(channel)]; }
};

/// Flattens a scene. The plan says which transport is used.
/// The scene must have passed evaluation: nothing here can fail on user input.
Stage compile(scene::Scene const& scene, plan::Plan const& plan);
/// The same; the scene's objects are given up one by one, so that large scenes are not there twice.
Stage compile(scene::Scene&& scene, plan::Plan const& plan);

} // namespace abbe::render
