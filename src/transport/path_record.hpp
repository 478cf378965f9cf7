// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "base/vec.hpp"
#include "transport/stage.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace abbe::transport {

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
class PathRecord {
public:
  explicit PathRecord(bool negative_is_wrong) : negative_is_wrong_(negative_is_wrong) {}

  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);
  /// A ray meets something, or nothing. @param from number of the ray that it comes of, or none
  /// @param through goes on behind what that one met @param light that it carries
  /// @return its number
  std::uint32_t arrive(std::uint32_t from, bool through, Vec3 const& direction,
                       std::span<double const> light, PathStep step);
  /// Light comes of what a ray met. @param to_sample not gathered apart
  void add(std::uint32_t ray, double light, bool to_sample);
  /// From the camera to the first ray that brought wrong light, or to that which brought most.
  std::vector<PathStep> path() const;

private:
  struct Ray {
    std::uint32_t parent;
    PathStep step;
    Vec3 direction;
  };
  bool negative_is_wrong_;
  std::vector<Ray> rays_;
  std::optional<std::uint32_t> guilty_;
  std::uint32_t brightest_ = 0; ///< the ray that brought the largest light
  double most_ = 0;
};

} // namespace abbe::transport
