// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "optics/channel_set.hpp"
#include "optics/comb.hpp"
#include "optics/glass.hpp"
#include "surface/reader.hpp"
#include "transport/air/air_effect.hpp"
#include "transport/cameras/camera.hpp"
#include "transport/cameras/lens.hpp"
#include "transport/lamps/lamp.hpp"
#include "transport/segments/segment.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// The scene made ready for rays: flattened, relative to the camera, every colour as one number a
/// channel. Immutable while rays are traced.
namespace abbe::transport {

using surface::Channels;

class WavelengthPolicy;
namespace caustics {
class Caustics;
}

/// What a ray may travel in. Number 0 is the surrounding air.
struct Medium {
  double index_d = 1;  ///< the index where no wavelength is distinguished
  Channels index;      ///< per channel at the band's mean wavelength, where it disperses
  Channels flat_index; ///< index_d for every channel, where it does not
  Segments segments;   ///< what it does to light on its way
  optics::Glass const* glass = nullptr; ///< for wavelengths of combs
  bool dispersive = false;
  bool fresnel = false;    ///< a real dielectric (glass {}): its faces reflect by Fresnel unasked
  int comb = -1;           ///< number of its comb (stochastic modes)
  double tolerance_px = 0; ///< of the adaptive mode; 0: every lane goes its own way
  WavelengthPolicy const* policy = nullptr; ///< how light goes on that it splits
  double caustics = 0; ///< exponent / 45 of what a crossing adds to a lamp's light
  bool refracts() const { return dispersive || index_d != 1; }
};

struct CompiledSolid {
  int medium = 0;             ///< of its inside
  bool has_medium = false;    ///< an interior was given: it counts as a medium
  bool shuts_out_air = false; ///< it is not hollow, and the scene has fog or the like
  std::uint16_t light_group = 0;
  /// Is it kept in mind that a ray is inside of it?
  bool counts() const { return has_medium || shuts_out_air; }
  int priority = 0;   ///< of the medium among those that overlap
  bool leaks = false; ///< rays may enter it and not leave it: left at its bounds
  /// Its surface does not enclose it: a ray that crosses it, whichever way, leaves what it is
  /// inside of and enters what it is not inside of, as in POV-Ray.
  bool open = false;
  bool sheet = false; ///< no point is inside of it unless a ray has entered it
  /// Of an interior as POV-Ray has it (Stage::interiors): its light fades where its own surface
  /// ends it, and nowhere else. Medium 0: none was written, in plain interiors it has an index
  /// of 1.
  bool plain = false;
  /// Surfaces enter and leave an interior of this number in place of the solid; -1: they do not.
  std::int32_t interior = -1;
  bool by_primitive = false; ///< each primitive's surface that of its own (Stage)
  /// Its surfaces enter the interior from outside and leave it from inside, whichever way.
  bool turns() const { return by_primitive || (interior >= 0 && open); }
};

/// An interior that solids share, or that its surfaces do not enclose. Where they do not, any of
/// its surfaces enters it when a ray is not inside of it and leaves it when it is, as in POV-Ray.
struct SharedInterior {
  int medium = 0;
  bool shuts_out_air = false;
};

/// World mask bits (geometry::visible_to_*): opaque and filtering casters of shadows apart.
inline constexpr std::uint8_t camera_bit = 1, reflection_bit = 2, opaque_shadow_bit = 4,
                              filter_shadow_bit = 8, caster_bit = 16;
/// What light from lamps meets that is followed for caustics.
inline constexpr std::uint8_t light_bits = opaque_shadow_bit | filter_shadow_bit | caster_bit;

/// How a solid throws light on (scene::Throws).
struct Casts {
  bool target = false; ///< light is sent to it; what comes straight through it is then left out
  bool collects = true, pass_through = false;
  scene::Choice refraction = scene::Choice::Unset, reflection = scene::Choice::Unset;
  /// Does light of a lamp go on there?
  static bool goes_on(scene::Choice own, scene::Choice lamp) {
    using scene::Choice;
    return (own == Choice::On && lamp != Choice::Off) || (lamp == Choice::On && own != Choice::Off);
  }
};

struct Stage {
  int channels = 3;
  std::optional<optics::ChannelSet> spectral; ///< nullopt: r g b
  std::unique_ptr<geometry::World> world;
  std::vector<CompiledSolid> solids; ///< by SolidId
  std::vector<SharedInterior> interiors;
  /// Numbers of interiors by PrimitiveId, of solids by_primitive; -1: none.
  std::vector<std::int32_t> primitive_interiors;
  surface::Textures textures;
  std::vector<Medium> media;                                 ///< [0] is air
  std::vector<std::shared_ptr<optics::Glass const>> glasses; ///< keeps Medium::glass alive
  std::vector<std::unique_ptr<Lamp const>> lamps;
  /// Does the lamp light surfaces of the group? By group and lamp; empty where there are no groups.
  std::vector<std::vector<bool>> lit_groups;
  Air air;                         ///< what is in it, the nearest to the camera first
  bool has_non_collectors = false; ///< some solid does not collect
  std::vector<Casts> casts;        ///< by SolidId; empty where the scene calls for no caustics
  /// Its surface shows light that falls on it; by PrimitiveId, and by SolidId; as `casts`.
  std::vector<bool> receives, solid_receives;
  std::shared_ptr<caustics::Caustics const> caustics; ///< the light of casters; or null
  /// Light of different combs is kept apart on the film because the wavelengths that it stands for
  /// differ.
  std::vector<optics::Comb> combs;
  Channels background;
  std::vector<int> sky_pigments; ///< pigments; the last on top
  Channels sky_emission;
  Mat3 to_sky_linear{1};
  Vec3 to_sky_offset{0};
  std::unique_ptr<Camera const> camera;
  std::optional<Lens> lens; ///< of focal blur
  int camera_normal = -1;   ///< in Textures::normals: tilts the camera's rays; -1: nothing does
  Vec3 eye{0};              ///< where the camera stands in the scene, which all else is relative to
  /// A ray with no lane above this throughput is dropped, and one below this
  /// level. What that takes away at most is summed up (CutLight).
  double adc_bailout = 1.0 / 255;
  int max_trace_level = 5;
  /// A sample that has taken more rays than these asks more and more of the next ones
  /// (Emitter::threshold), so that rays that part again and again come to an end; 0: it does not.
  std::uint32_t most_rays = 0;
  double brightest = 0; ///< no path returns more: bound of the radiance, any channel
  bool has_filter_shadows = false;
  bool has_priorities = false;    ///< some medium has another priority than 0
  bool has_leaks = false;         ///< some medium's solid leaks
  bool has_adaptive = false;      ///< some medium has a tolerance
  std::vector<Vec3> rgb_weights;  ///< colour of one unit of each channel
  std::vector<double> lambdas_nm; ///< of the channels, unless they are r g b

  surface::Reader reader() const { return {textures, *world}; }
  Medium const& medium(int number) const { return media[static_cast<std::size_t>(number)]; }
  /// Number of the shared interior that a surface is of; -1: none.
  std::int32_t interior_of(geometry::SolidId solid, geometry::PrimitiveId primitive) const {
    CompiledSolid const& own = solids[solid];
    return own.by_primitive ? primitive_interiors[primitive] : own.interior;
  }
  /// Of the interior that a surface is of.
  double focus(geometry::SurfaceCrossing const& at) const {
    CompiledSolid const& own = solids[at.solid];
    if (!own.by_primitive) return medium(own.medium).caustics;
    std::int32_t const number = primitive_interiors[at.primitive];
    return number < 0 ? 0 : medium(interiors[static_cast<std::size_t>(number)].medium).caustics;
  }
  optics::Comb const& comb(int number) const { return combs[static_cast<std::size_t>(number)]; }
  optics::Bands const& bands() const { return spectral->bands; }
  /// Of the spectral film.
  std::size_t film_bands() const {
    return spectral ? static_cast<std::size_t>(bands().count()) : 0;
  }
  double lambda_nm(int channel) const { return lambdas_nm[static_cast<std::size_t>(channel)]; }
};

} // namespace abbe::transport
