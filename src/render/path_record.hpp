// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "base/vec.hpp"
#include "render/wave_tables.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace abbe::render {

struct Beam;
struct PathRay;
class Tracer;

/// One ray of a path, and the surface that it met.
struct PathStep {
  enum class Kind : std::uint8_t { Camera, Reflected, Refracted, Passed };
  Kind kind = Kind::Camera;
  int lanes = 0;                   ///< how many channels of light travel on it
  std::optional<double> lambda_nm; ///< of a ray that a dispersing surface has split
  bool met = false;                ///< false: it met nothing, its light is the background's
  Span object;                     ///< the shape that was met
  std::string_view keyword;        ///< its kind: "sphere"
  Vec3 point{0};                   ///< where, in the scene's coordinates
  bool in_order = true;            ///< the light it carries was finite and not negative
};

/// A sample that no picture may hold, and how it came about.
struct BadSample {
  enum class Kind : std::uint8_t { NotANumber, Infinite, Negative };
  Kind kind = Kind::NotANumber;
  int x = 0, y = 0;         ///< pixel
  std::uint64_t sample = 0; ///< of the pixel
  Vec3 rgb{0};
  /// From the camera to the surface (or the background) whose light or whose share of it is wrong;
  /// where the parts are in order and only their sum is too large, to the largest of them.
  std::vector<PathStep> path;
};

/// Is light negative only by mistake? False for scenes that ask for it: a light, pigment, glow or
/// background with a negative channel, which POV-Ray's language admits.
bool negative_light_is_wrong(Stage const& stage);

/// What is wrong with a sample: its light a channel or the colour (as the picture's floats).
std::optional<BadSample::Kind> what_is_wrong(std::span<double const> light, Vec3 const& rgb,
                                             bool negative_is_wrong);

/// Follows the tracing of one sample, ray by ray, and finds the first that brings wrong light.
/// Tracers tell it of rays only when they were given one (Tracer::record).
class PathRecorder {
public:
  PathRecorder(Stage const& stage, bool negative_is_wrong);

  /// A ray begins; the one before it has done what it does before its first child.
  void begin(Tracer& tracer, int depth, PathRay const& ray, Beam const& beam);
  /// The sample is complete: Tracer::sample has returned.
  void end(Tracer& tracer);
  std::vector<PathStep> path() const;

private:
  struct Ray {
    int depth;
    std::size_t parent;
    PathStep step;
    Vec3 direction;
  };
  void look_at_last(Tracer& tracer);
  void take_hit(Tracer& tracer, Ray& ray);

  Stage const& stage_;
  bool negative_is_wrong_;
  std::vector<Ray> rays_;
  std::optional<std::size_t> guilty_;
  std::size_t brightest_ = 0; ///< the ray that brought the largest light
  std::vector<double> film_;  ///< before the last ray
  double most_ = 0;
};

} // namespace abbe::render
