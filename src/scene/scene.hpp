// SPDX-License-Identifier: MIT
#pragma once

#include "base/few.hpp"
#include "base/shared.hpp"
#include "base/shared_list.hpp"
#include "base/source.hpp"
#include "base/vec.hpp"
#include "geometry/placement.hpp"
#include "geometry/shape_ptr.hpp"
#include "scene/air.hpp"
#include "scene/camera.hpp"
#include "scene/colour.hpp"
#include "scene/dispersion_mode.hpp"
#include "scene/effects.hpp"
#include "scene/light.hpp"
#include "scene/thrown_light.hpp"
#include "texture/pattern.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::optics {
class Glass;
class Conductor;
} // namespace abbe::optics

/// A scene as plain data: what the language evaluates to and the renderer reads. No algorithms.
/// World coordinates are the scene's own; angles are degrees as written.
namespace abbe::scene {

struct Pigment {
  Span span;
  Colour colour; ///< of a plain pigment
  /// Of a patterned one; then `entries` has the map (ascending values) or the list's items.
  std::shared_ptr<texture::PatternInstance const> pattern;
  struct Entry {
    double value = 0;
    std::shared_ptr<Pigment const> pigment;
  };
  std::vector<Entry> entries;
  bool default_entries = false; ///< the scene gave no map: entries are the pattern's own
  /// `quick_color`: of the whole pigment at low qualities (plan/quality.hpp); null: none.
  std::shared_ptr<Colour const> quick_colour;
};

struct Reflection {
  Colour minimum;
  Colour maximum;
  bool fresnel = false;
  double falloff = 1;
  double exponent = 1; ///< as written: the reflected colour is raised to 1 / exponent
  double metallic = 0;
  std::shared_ptr<optics::Conductor const> metal; ///< reflectance by n and k; replaces the colours
};

/// POV-Ray's finish; defaults are POV-Ray's.
struct Finish {
  Colour ambient{Vec3(0.1), 0, 0, nullptr};
  Colour emission;
  double diffuse = 0.6;
  double diffuse_back = 0;
  double brilliance = 1;
  double phong = 0;
  double phong_size = 40;
  double specular = 0;
  double roughness = 0.05;
  double metallic = 0;
  std::optional<Reflection> reflection;
  bool conserve_energy = false;
  double crand = 0; ///< film grain: how much diffuse light is taken away at random
  /// A thin film: how much it shows, its thickness in micrometres, and how much that varies.
  double irid = 0, irid_thickness = 0, irid_turbulence = 0;
};

/// What tilts the normals of a surface.
struct Normal {
  Span span;
  std::shared_ptr<texture::PatternInstance const> pattern;
  double amount = 0.5;        ///< bump_size
  double accuracy = 0.02;     ///< how far apart the pattern is looked at for its slope
  bool no_bump_scale = false; ///< bumps of a larger pattern are not higher
  /// A slope_map: heights and slopes along the pattern's value.
  struct Slope {
    double value = 0, height = 0, slope = 0;
  };
  std::vector<Slope> slopes;
  /// A normal_map, or a list's items.
  struct Entry {
    double value = 0;
    std::shared_ptr<Normal const> normal;
  };
  std::vector<Entry> entries;
};

struct TextureMap;

/// One layer of a texture.
struct Texture {
  Span span;
  Pigment pigment;
  Shared<Finish> finish;
  std::shared_ptr<Normal const> normal; ///< null as a rule
  /// Of a patterned texture, in place of pigment, finish and normal; null as a rule.
  std::shared_ptr<TextureMap const> map;
  bool uv = false; ///< it is asked for at <u, v, 0> of the surface instead of the point
  /// Texture space -> the space that its object stands in (Object's parent; the world in a Scene).
  geometry::Placement placement;
};
/// From the bottom (first written) to the top.
using Layers = std::vector<Texture>;
/// Textures that a pattern chooses.
struct TextureMap {
  std::shared_ptr<texture::PatternInstance const> pattern;
  struct Entry {
    double value = 0;
    Layers layers;
  };
  std::vector<Entry> entries;
};
/// Layers that objects may share, or none.
using SharedLayers = Shared<Layers>;

struct Interior {
  Span span;
  double ior = 1;
  std::shared_ptr<optics::Glass const> glass; ///< replaces ior when set
  double pov_dispersion = 1;                  ///< ratio of violet to red index
  int pov_dispersion_samples = 7;
  DispersionMode dispersion;
  double caustics = 0;
  double fade_distance = 0;
  double fade_power = 0;
  Colour fade_colour;
  int priority = 0; ///< where solids overlap, the highest displaces the others; equal: the later
                    ///< entered counts
};

/// A shape or a CSG combination. While a scene is read, `placement` takes the shape or the children
/// to the parent's space; clipping objects, textures and lights are in the parent's space already
/// (so that nothing is ever transformed there and back). In a finished Scene all of that is worked
/// in: placements of combinations are the identity, and leaves, clipping objects and textures are
/// in world space (of textures that look alike everywhere, most have no placement at all); every
/// leaf has its texture, its interior and all its flags.
struct Object {
  /// LightGroup: a union while it is read, whose lights and objects belong together.
  enum class Kind : std::uint8_t { Shape, Union, Merge, Intersection, Difference, LightGroup };
  Span span;
  Kind kind = Kind::Shape;
  geometry::ShapePtr shape;    ///< of Kind::Shape
  std::string_view keyword;    ///< "sphere", of Kind::Shape
  SharedList<Object> children; ///< of the others
  /// In a finished Scene, of a union that is stored once for many places: what stands there, in a
  /// space of its own, which `placement` takes to the object's; `children` is empty then. What is
  /// in it has an opaque, plain texture and no more, flags are those of the union, and unions in it
  /// may again be such.
  std::shared_ptr<Object const> instance;
  Few<Object> clipped_by;
  geometry::Placement placement; ///< of the shape or of the children
  Few<Light> lights;             ///< written inside a union; moved to Scene::lights at insertion
  SharedLayers texture;          ///< own; else the parent's, else the default at insertion
  SharedLayers interior_texture;
  Few<Layers> face_textures;
  std::shared_ptr<Interior const> interior;
  bool inverse = false;
  bool uv_mapping = false; ///< of all its textures
  /// Surfaces of parts without a texture take those of the parts that they cut; worked in in a
  /// finished Scene.
  bool cutaway_textures = false;
  bool global_lights = false;    ///< of a LightGroup: lights outside of it light it too
  std::uint16_t light_group = 0; ///< in a finished Scene: number in Scene::light_groups, or 0
  Throws throws;
  std::optional<bool> hollow, no_shadow, no_image, no_reflection, double_illuminate;
  Few<Object> bounded_by; ///< for `clipped_by { bounded_by }` only; empty in a finished Scene
};

/// How light is put into numbers (docs/dispersion.md).
/// Bands: means over bands. Composite: bands for what is smooth, and a channel for each emission
/// line. Basis: wavelengths and weights that are exact for the scene's own lights and colours.
/// Adaptive: bands as fine as these need, where they need it.
struct Representation {
  enum class Kind : std::uint8_t { Bands, Composite, Basis, Adaptive } kind = Kind::Bands;
  int size = 0;           ///< of a basis
  double tolerance = 0.5; ///< of Adaptive: CIEDE2000 of the worst colour
  bool operator==(Representation const&) const = default;
};

struct SpectralSettings {
  Span span;
  bool requested = false; ///< a `spectral` block stands in the scene
  int bands = 16;
  double low_nm = 380;
  double high_nm = 780;
  enum class Spacing : std::uint8_t { Uniform, Hall, Boundaries } spacing = Spacing::Uniform;
  std::vector<double> boundaries_nm;
  Representation representation;
  DispersionMode dispersion{DispersionMode::Kind::Deterministic, {}, 0.5, {}};
  /// Wavelengths that land less than so many pixels apart share a ray, in all materials that are
  /// deterministic or adaptive; 0: none does. Not given: as each material says.
  std::optional<double> merge_px;
  double mm_per_unit = 1;
};

/// `samples A, B error E`: how many rays a pixel gets.
struct SampleSettings {
  static constexpr int most_of_all = 1 << 24;
  static constexpr double default_error = 0.05;
  int least = 1, most = 1;
  double error = default_error; ///< of the pixel as displayed, 0 to 1, that is good enough
};

struct Settings {
  /// Where paths end. Neither given: where what they can still add is below a bound (render).
  /// One given: POV-Ray's meaning, and its default (1/255, 5) of the other.
  std::optional<double> adc_bailout;
  std::optional<int> max_trace_level;
  Vec3 irid_wavelength{0.7, 0.52, 0.48}; ///< that thin films show in r, g and b, in micrometres
  Colour ambient_light{Vec3(1), 0, 0, nullptr};
  /// nullopt: not given (then 1 for version >= 3.7, no encoding at all below).
  std::optional<double> assumed_gamma;
  bool assumed_gamma_srgb = false;
  double version = 3.62; ///< effective at the end of the parse
  int noise_generator = 2;
  /// Facing surfaces of two refracting solids that are closer than this share of the smaller one's
  /// extent are in contact. 0: never. The default is what seven decimal digits leave.
  static constexpr double default_contact = 0x1p-22;
  double contact = default_contact;
  SpectralSettings spectral;
  ThrownLight thrown;
  EffectSettings effects;
  std::optional<SampleSettings> samples; ///< nothing: as the command line says
};

struct SkySphere {
  Span span;
  std::vector<Pigment> pigments; ///< the last on top
  Colour emission{Vec3(1), 0, 0, nullptr};
  geometry::Transform placement;
};

struct Scene {
  std::deque<Object> objects; ///< in text order; every leaf has a texture
  std::vector<Light> lights;
  Camera camera;
  Colour background;
  bool has_background = false; ///< a `background` stands in the scene: it is there in alpha too
  std::optional<SkySphere> sky_sphere;
  std::vector<Fog> fogs;
  std::vector<Rainbow> rainbows;
  std::vector<LightGroup> light_groups; ///< number 1 first
  Settings settings;
};

} // namespace abbe::scene
