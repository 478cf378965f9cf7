// SPDX-License-Identifier: MIT
#pragma once

#include "transport/lamps/lamp.hpp"

namespace abbe::transport {

/// Light of one direction. It is everywhere, as in POV-Ray: behind the lamp's plane, where the
/// distance is negative, without shadows.
class ParallelLamp : public Lamp {
public:
  /// @param position of a point of the plane that it comes from @param direction unit, of its light
  ParallelLamp(Common common, Vec3 const& position, Vec3 const& direction)
      : Lamp(std::move(common)), position_(position), direction_(direction) {}
  std::optional<caustics::LampRays> rays() const override {
    return {{true, position_, direction_}};
  }

protected:
  void find_ways(Vectors const& points, std::size_t count, Aim& out) const override;
  bool lights_itself() const override { return true; }

  Vec3 position_, direction_;
};

} // namespace abbe::transport
