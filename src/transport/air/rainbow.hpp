// SPDX-License-Identifier: MIT
#pragma once

#include "transport/air/air_effect.hpp"

#include <limits>

namespace abbe::transport {

/// One rainbow: a ring of colours about a direction, which light shows through the more the nearer
/// it comes from.
/// @source POV-Ray's documentation, 3.4.3.4 (rainbow); what its program shows
struct Bow {
  Vec3 axis{0, 0, 1};               ///< unit: the middle of the ring
  Vec3 up{0, 1, 0}, right{1, 0, 0}; ///< unit, across it: where the arc is highest
  double inner_rad = 0, width_rad = 1;
  double distance = 1; ///< of which light keeps 1 / e
  double jitter = 0;   ///< shift of a ray's place in the colours, at most
  /// Half of the arc that is there, and of the part of it that does not fade; above pi: a whole
  /// ring.
  double arc_rad = std::numeric_limits<double>::infinity(), falloff_rad = arc_rad;
  struct Entry {
    double value = 0;
    AirColour colour;
  };
  /// Ascending, one at least. Where one filters, all have a tint.
  std::vector<Entry> entries;

  /// Where a ray meets the ring: 0 at its inner edge, 1 at the outer one. @param fade 1: whole
  /// @return false: it does not
  bool meet(Vec3 const& direction, double& place, double& fade) const;
};

/// All rainbows of a scene: a ray sees the mean of those that it meets, as in POV-Ray.
class Rainbow final : public AirEffect {
public:
  explicit Rainbow(std::vector<Bow> bows) : bows_(std::move(bows)) {}
  void along(AirWay const& way) const override;
  double brightest() const override;

private:
  std::vector<Bow> bows_;
};

} // namespace abbe::transport
