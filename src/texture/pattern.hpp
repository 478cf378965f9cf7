// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "base/vec.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Patterns: functions of a point that pigments, normals and textures look up in a map.
/// A leaf library: it knows neither colours nor the language.
namespace abbe::texture {

struct Turbulence {
  Vec3 amount{0};
  int octaves = 6;
  double omega = 0.5;
  double lambda = 2;
};

enum class Wave : std::uint8_t { Ramp, Triangle, Sine, Scallop, Cubic, Poly };

/// What may be written after a pattern and acts on every pattern alike.
struct PatternModifiers {
  /// Present as soon as turbulence, octaves, omega or lambda is written.
  std::optional<Turbulence> turbulence;
  std::optional<double> frequency; ///< default: Pattern::default_frequency()
  double phase = 0;
  std::optional<Wave> wave; ///< default: Pattern::default_wave()
  double poly_exponent = 1;
  int noise_generator = 2;
};

/// How a ray meets the surface that a pattern is asked for on, for patterns of more than a point.
struct Sight {
  Vec3 normal{0};    ///< unit, as perturbed so far, on the side of the ray
  Vec3 direction{0}; ///< of the ray, unit
  Vec2 uv{0};        ///< the surface's own coordinates there
};

/// A colour that a pattern has by itself, in the working space of the scene.
struct PatternColour {
  Vec3 rgb{0};
  double filter = 0, transmit = 0;
};

class Pattern {
public:
  virtual ~Pattern() = default;
  /// The raw value at a point that already went through warps, transforms and (unless
  /// uses_turbulence_itself) classic turbulence.
  virtual double raw(Vec3 const& point, PatternModifiers const& modifiers) const = 0;
  /// The same on a surface. @param sight null where there is none (a sky, a function)
  virtual double raw_on(Vec3 const& point, PatternModifiers const& modifiers,
                        Sight const* /*sight*/) const {
    return raw(point, modifiers);
  }
  /// It has colours of its own, as an image has, and takes no map.
  virtual bool has_colours() const { return false; }
  virtual PatternColour colour_at(Vec3 const& /*point*/) const { return {}; }
  /// Is any of these see-through?
  virtual bool lets_light_pass() const { return false; }
  /// Does it ask for the normal or the ray of a Sight?
  virtual bool looks() const { return false; }
  /// Tilts a normal in a way of its own, which bumps, waves and their like have, by `amount`.
  /// @return false: it has none; the gradient of the value tilts normals
  virtual bool tilt(Vec3 const& /*point*/, PatternModifiers const&, double /*amount*/,
                    Vec3& /*normal*/) const {
    return false;
  }
  /// Has it a value? What tilts normals and nothing else has none and stands in normals alone.
  virtual bool has_value() const { return true; }
  /// Number of items of a list pattern (checker 2, brick 2); 0: it takes a map.
  virtual int list_size() const { return 0; }
  /// The entries of a map are mixed all at once, their values are weights.
  virtual bool averages() const { return false; }
  virtual double default_frequency() const { return 1; }
  virtual Wave default_wave() const { return Wave::Ramp; }
  /// marble, wood: turbulence enters the formula, not the point.
  virtual bool uses_turbulence_itself() const { return false; }
  /// A pattern's own pigment map, [value, r, g, b], where the scene gives none (section 7.1 of the
  /// language notes); for list patterns one row an item.
  struct DefaultEntry {
    double value;
    Vec3 rgb;
  };
  virtual std::span<DefaultEntry const> default_map() const; // black 0 -> white 1
  /// Reads one of the pattern's own items (brick_size, mortar, form, metric, offset, solid,
  /// agate_turb, control0 ...) when one is next. They may stand anywhere after the keyword, also
  /// behind the items of a list, so ask again wherever a modifier may stand.
  /// @return the pattern with that item; null when the next item is none of them
  virtual std::shared_ptr<Pattern const> read_item(Parameters&) const { return nullptr; }
};

/// A change of the point that a pattern is asked for at, which is no transform.
class Warp {
public:
  virtual ~Warp() = default;
  virtual Vec3 apply(Vec3 const& point) const = 0;
};

/// One step of the way from the surrounding space into the pattern's: an inverse affine transform,
/// or a warp.
struct Mapping {
  Mat3 linear{1};
  Vec3 offset{0};
  std::shared_ptr<Warp const> warp{}; ///< in place of the transform
};

/// A pattern with its modifiers and transforms, ready to be evaluated.
struct PatternInstance {
  std::shared_ptr<Pattern const> pattern;
  PatternModifiers modifiers;
  /// Inverse transforms and warps in the order written; the last acts on the point first.
  std::vector<Mapping> mappings;

  bool uv = false; ///< it is asked for at <u, v, 0> of the surface instead of the point

  /// The way into the pattern's space, which the entries of a map go too: transforms, warps, and
  /// last the classic turbulence.
  Vec3 place(Vec3 const& point, Sight const* sight = nullptr) const;
  /// The value after frequency, phase and wave: what a map is looked up with. For list patterns the
  /// item's number, to be looked up among 0, 1 ...: a frequency, phase or wave that is written acts
  /// on it too and leads in between (`checker ... sine_wave` is half of each, as in POV-Ray).
  /// @param placed what place() gives
  double value(Vec3 const& placed, Sight const* sight = nullptr) const;
  double evaluate(Vec3 const& point, Sight const* sight = nullptr) const {
    return value(place(point, sight), sight);
  }
};

/// Where a value falls in a map: entry `first`, or a blend of `first` and `second` by `weight`.
struct MapPosition {
  int first = 0;
  int second = 0;
  double weight = 0; ///< of `second`
};
/// POV-Ray's look-up: below the first -> first; >= last -> last; at a step the first of the equals.
MapPosition look_up(std::span<double const> ascending_values, double value);

struct PatternKind {
  std::string_view keyword;
  std::shared_ptr<Pattern const> (*read)(Parameters&); ///< reads what follows the keyword
};
/// All patterns: one line each in texture/patterns/registry.cpp.
std::span<PatternKind const> pattern_kinds();

struct WarpKind {
  std::string_view keyword;
  std::shared_ptr<Warp const> (*read)(Parameters&); ///< reads what follows the keyword
};
/// All warps: one line each in texture/warps/registry.cpp.
std::span<WarpKind const> warp_kinds();

/// Reads one modifier (turbulence, octaves, omega, lambda, frequency, phase, *_wave,
/// noise_generator) when one is next. @return false when the next item is none of them
bool read_modifier(Parameters&, PatternModifiers&);
/// The same of octaves, omega and lambda alone.
bool read_turbulence_item(Parameters&, PatternModifiers&);

/// Noise and its kin, exactly as section 9 of the language notes defines them.
double noise(Vec3 const& point, int generator = 2);
/// Bound of each component of the gradient of noise().
double noise_slope(int generator);
Vec3 vector_noise(Vec3 const& point);
double turbulence(Vec3 const& point, Turbulence const&, int generator = 2);
Vec3 vector_turbulence(Vec3 const& point, Turbulence const&);

} // namespace abbe::texture
