// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "scene/colour.hpp"
#include "texture/pattern.hpp"

#include <optional>
#include <vector>

/// What is in the air.
namespace abbe::scene {

struct Fog {
  Span span;
  Colour colour;
  bool ground = false; ///< fog_type 2
  double distance = 0;
  double offset = 0, alt = 0; ///< of ground fog
  Vec3 up{0, 1, 0};           ///< unit
  std::optional<texture::Turbulence> turbulence;
  double turbulence_depth = 0.5;
};

struct Rainbow {
  Span span;
  Vec3 direction{0};
  Vec3 up{0, 1, 0};
  double angle_deg = 0, width_deg = 0, distance = 0, jitter = 0;
  std::optional<double> arc_deg, falloff_deg;
  struct Entry {
    double value = 0;
    Colour colour;
  };
  std::vector<Entry> entries; ///< ascending
};

} // namespace abbe::scene
