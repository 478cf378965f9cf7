// SPDX-License-Identifier: MIT
#pragma once

#include "transport/lamps/lamp.hpp"

namespace abbe::transport {

/// Light that comes from a point.
class PointLamp : public Lamp {
public:
  PointLamp(Common common, Vec3 const& position) : Lamp(std::move(common)), position_(position) {}
  std::optional<caustics::LampRays> rays() const override { return {{false, position_, Vec3(0)}}; }

protected:
  void find_ways(Vectors const& points, std::size_t count, Aim& out) const override;

private:
  Vec3 position_; ///< relative to the camera
};

} // namespace abbe::transport
