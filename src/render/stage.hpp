// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "optics/channel_set.hpp"
#include "optics/comb.hpp"
#include "optics/glass.hpp"
#include "plan/plan.hpp"
#include "render/surfaces.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// The scene made ready for rays: flattened, relative to the camera, every colour as one number a
/// channel. Immutable while rays are traced.
namespace abbe::render {

/// Channels of light: the spectral bands, or r g b.
using Channels = std::vector<double>;

/// A map of pigments along a pattern.
struct CompiledPattern {
  std::shared_ptr<texture::PatternInstance const> pattern;
  std::vector<double> values;
  std::vector<int> entries; ///< numbers of pigments
};

/// A million objects may each have their own: small, and without anything of its own to hold.
struct CompiledPigment {
  double filter = 0, transmit = 0; ///< of a plain one
  std::uint32_t colour = 0;        ///< of a plain one: number of its colour (Stage::colour)
  std::int32_t pattern = -1;       ///< in Stage::patterns; -1: the same everywhere
  bool opaque = true;              ///< nowhere does light pass
};

struct CompiledReflection {
  Channels minimum, maximum;
  bool fresnel = false;
  double falloff = 1;
  double exponent = 1;
  double metallic = 0;
  Channels metal_n, metal_k; ///< set for a metal by n and k
};

struct CompiledFinish {
  Channels ambient; ///< times the global ambient light; empty when zero
  Channels emission;
  double diffuse = 0, diffuse_back = 0, brilliance = 1;
  double phong = 0, phong_size = 40;
  double specular = 0, roughness = 0.05;
  double metallic = 0;
  std::optional<CompiledReflection> reflection;
  bool conserve_energy = false;
};

/// World (relative to the camera) -> texture space.
struct TextureSpace {
  Mat3 linear{1};
  Vec3 offset{0};
};

struct CompiledLayer {
  int pigment = 0;
  int finish = 0; ///< in Stage::finishes
  int space = 0;  ///< in Stage::texture_spaces; used by patterns only
};

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
  bool refracts() const { return dispersive || index_d != 1; }
};

struct CompiledSolid {
  int medium = 0;          ///< of its inside
  bool has_medium = false; ///< an interior was given: it counts as a medium
  int priority = 0;        ///< of the medium among those that overlap
  bool leaks = false;      ///< rays may enter it and not leave it: left at its bounds
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
  Surfaces surfaces;                 ///< by PrimitiveId
  std::vector<CompiledSolid> solids; ///< by SolidId
  std::vector<CompiledLayer> layers;
  std::vector<CompiledFinish> finishes;
  std::vector<TextureSpace> texture_spaces{{}}; ///< [0]: the world's
  std::vector<CompiledPigment> pigments;
  std::vector<CompiledPattern> patterns;
  std::vector<double> colours; ///< reflectances of plain pigments, channel by channel
  std::vector<Medium> media;   ///< [0] is air
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
  /// A ray with no lane above this throughput is dropped, and one below this level. What that takes
  /// away at most is summed up (CutLight).
  double adc_bailout = 1.0 / 255;
  int max_trace_level = 5;
  double brightest = 0;         ///< no path returns more: bound of the radiance, any channel
  double opacity_version = 3.7; ///< < 3.7: POV-Ray's older rule of opacity
  bool has_filter_shadows = false;
  bool has_priorities = false;    ///< some medium has another priority than 0
  bool has_leaks = false;         ///< some medium's solid leaks
  std::vector<Vec3> rgb_weights;  ///< colour of one unit of each channel
  std::vector<double> lambdas_nm; ///< of the channels, unless they are r g b

  optics::Bands const& bands() const { return spectral->bands; }
  /// Of the spectral film.
  std::size_t film_bands() const {
    return spectral ? static_cast<std::size_t>(bands().count()) : 0;
  }
  double lambda_nm(int channel) const { return lambdas_nm[static_cast<std::size_t>(channel)]; }
  /// Channel by channel, that of a plain pigment.
  double const* colour(CompiledPigment const& pigment) const {
    return colours.data() + pigment.colour * static_cast<std::size_t>(channels);
  }
  CompiledFinish const& finish(CompiledLayer const& layer) const {
    return finishes[static_cast<std::size_t>(layer.finish)];
  }
  Vec3 to_texture(CompiledLayer const& layer, Vec3 const& point) const {
    TextureSpace const& space = texture_spaces[static_cast<std::size_t>(layer.space)];
    return space.linear * point + space.offset;
  }
  /// Does any texture of a surface ask for `reflection`?
  bool mirrors(Surface const& surface) const;
};

/// Flattens a scene. The plan says which transport is used.
/// The scene must have passed evaluation: nothing here can fail on user input.
Stage compile(scene::Scene const& scene, plan::Plan const& plan);
/// The same; the scene's objects are given up one by one, so that large scenes are not there twice.
Stage compile(scene::Scene&& scene, plan::Plan const& plan);

} // namespace abbe::render
