// SPDX-License-Identifier: MIT
#pragma once

#include "transport/lamps/parallel.hpp"

namespace abbe::transport {

/// Parallel light about an axis, in front of its plane only.
/// @source POV-Ray's documentation, 3.4.7.2 (cylindrical light); what its program shows
class CylinderLamp final : public ParallelLamp {
public:
  /// @param radius within it, light is whole @param falloff beyond it there is none; within the
  /// radius, the edge is hard @param tightness power of what is left of 1 on the way to `falloff`
  CylinderLamp(Common common, Vec3 const& position, Vec3 const& direction, double radius,
               double falloff, double tightness)
      : ParallelLamp(std::move(common), position, direction),
        radius_(radius),
        falloff_(falloff),
        tightness_(tightness) {}

protected:
  void find_ways(Vectors const& points, std::size_t count, Aim& out) const override;
  bool even() const override { return false; }
  double share(Aim const& aim, std::size_t ray) const override;

private:
  double radius_, falloff_, tightness_;
};

} // namespace abbe::transport
