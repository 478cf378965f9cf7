// SPDX-License-Identifier: MIT
#pragma once

#include "surface/textures.hpp"
#include "transport/lanes.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace abbe::transport {

/// Rays on their way through open air: from where they start to what they meet. Arrays with a value
/// a lane hold the first ray's lanes first.
struct AirWay {
  std::size_t each = 0;                   ///< lanes a ray
  RaySet rays = 0;                        ///< those that go through open air
  Vectors const* origin = nullptr;        ///< relative to the camera
  Vectors const* direction = nullptr;     ///< unit
  double const* distance = nullptr;       ///< a ray; may be infinite
  std::uint16_t const* channel = nullptr; ///< a lane
  double* left = nullptr;  ///< a lane: the share of light that passes what is in front; in and out
  double* added = nullptr; ///< a lane: light of the air itself, as it arrives; in and out
};

/// What is in the air, such as fog, does to light on its way. A new one: a file here, and a line in
/// air.cpp.
class AirEffect {
public:
  virtual ~AirEffect() = default;
  /// Light that comes to the camera. Effects that come earlier in the list are in front.
  virtual void along(AirWay const&) const = 0;
  /// Of what it adds, any channel.
  virtual double brightest() const = 0;
  /// Light from lamps that the air weakens (`media_attenuation`): `left` only.
  virtual void to_lamp(AirWay const&) const {}
};

using Air = std::vector<std::unique_ptr<AirEffect const>>;

/// A colour that fills the air, or lets light pass.
struct AirColour {
  surface::Channels light; ///< by channel
  surface::Channels tint;  ///< the same as a filter; empty where `filter` is 0
  double filter = 0, transmit = 0;
  double brightest() const {
    return light.empty() ? 0 : *std::max_element(light.begin(), light.end());
  }
};

} // namespace abbe::transport
