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

/// Patterns: functions of a point that pigments (and later normals and densities) look up in a map.
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

class Pattern {
public:
  virtual ~Pattern() = default;
  /// The raw value at a point that already went through warps, transforms and (unless
  /// uses_turbulence_itself) classic turbulence.
  virtual double raw(Vec3 const& point, PatternModifiers const& modifiers) const = 0;
  /// Number of items of a list pattern (checker 2, brick 2); 0: it takes a map.
  virtual int list_size() const { return 0; }
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

/// One step of the way from the surrounding space into the pattern's: an inverse affine transform.
struct Mapping {
  Mat3 linear{1};
  Vec3 offset{0};
};

/// A pattern with its modifiers and transforms, ready to be evaluated.
struct PatternInstance {
  std::shared_ptr<Pattern const> pattern;
  PatternModifiers modifiers;
  /// Inverse transforms and warps in the order written; the last acts on the point first.
  std::vector<Mapping> mappings;

  /// The value after frequency, phase and wave: what a map is looked up with. For list patterns the
  /// item's number, to be looked up among 0, 1 ...: a frequency, phase or wave that is written acts
  /// on it too and leads in between (`checker ... sine_wave` is half of each, as in POV-Ray).
  double evaluate(Vec3 const& point) const;
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

/// Reads one modifier (turbulence, octaves, omega, lambda, frequency, phase, *_wave,
/// noise_generator) when one is next. @return false when the next item is none of them
bool read_modifier(Parameters&, PatternModifiers&);

/// Noise and its kin, exactly as section 9 of the language notes defines them.
double noise(Vec3 const& point, int generator = 2);
/// Bound of each component of the gradient of noise().
double noise_slope(int generator);
Vec3 vector_noise(Vec3 const& point);
double turbulence(Vec3 const& point, Turbulence const&, int generator = 2);
Vec3 vector_turbulence(Vec3 const& point, Turbulence const&);

} // namespace abbe::texture
