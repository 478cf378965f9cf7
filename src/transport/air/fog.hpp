// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"
#include "transport/air/air_effect.hpp"

#include <optional>

namespace abbe::transport {

/// One fog. Light that goes the way w keeps the share exp(-w / distance), and the rest is replaced
/// by the fog's colour. Of ground fog, w counts by its density: 1 up to the height `offset`, and
/// 1 / (1 + ((height - offset) / alt)^2) above.
/// @source POV-Ray's documentation, 3.4.3.2 (fog); what its program shows (docs/compatibility.md)
struct FogLayer {
  AirColour colour;
  double distance = 1; ///< above 0
  bool ground = false;
  Vec3 up{0, 1, 0}; ///< unit
  double offset = 0, alt = 1;
  /// Makes the way shorter by up to exp(-w / distance), by noise in the middle of it.
  std::optional<texture::Turbulence> turbulence;
  double turbulence_depth = 0.5;
  int noise_generator = 2;

  /// What counts of a way. @param origin in the scene @param length not negative, finite
  double depth(Vec3 const& origin, Vec3 const& direction, double length) const;
  /// The share of light that passes without a filter's colour: at least `transmit`.
  double passed(Vec3 const& origin, Vec3 const& direction, double length) const;
};

/// All fogs of a scene: what they let pass multiplies, what they add is added, as in POV-Ray.
class Fog final : public AirEffect {
public:
  /// @param eye where the camera stands in the scene
  Fog(std::vector<FogLayer> layers, Vec3 const& eye) : layers_(std::move(layers)), eye_(eye) {}
  void along(AirWay const& way) const override { act(way, way.added); }
  void to_lamp(AirWay const& way) const override { act(way, nullptr); }
  double brightest() const override;

private:
  void act(AirWay const& way, double* added) const;
  std::vector<FogLayer> layers_;
  Vec3 eye_;
};

} // namespace abbe::transport
