// SPDX-License-Identifier: MIT
#pragma once

#include "transport/lamps/point.hpp"

namespace abbe::transport {

/// Light that comes from a point, most of it about one direction.
/// @source POV-Ray's documentation, 3.4.7.1 (spotlight)
class SpotLamp final : public PointLamp {
public:
  /// @param direction unit, of its axis @param cos_radius within it, light is whole
  /// @param cos_falloff beyond it there is none @param tightness power of the cosine
  SpotLamp(Common common, Vec3 const& position, Vec3 const& direction, double cos_radius,
           double cos_falloff, double tightness)
      : PointLamp(std::move(common), position),
        direction_(direction),
        cos_radius_(cos_radius),
        cos_falloff_(cos_falloff),
        tightness_(tightness) {}

protected:
  bool even() const override { return false; }
  double share(Aim const& aim, std::size_t ray) const override;

private:
  Vec3 direction_;
  double cos_radius_, cos_falloff_, tightness_;
};

} // namespace abbe::transport
