// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "scene/colour.hpp"
#include "scene/thrown_light.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace abbe::scene {

struct Object;

/// An area light: a grid of places that light comes from.
struct AreaGrid {
  Vec3 axis1{0}, axis2{0}; ///< from edge to edge
  int size1 = 1, size2 = 1;
  /// Shadows are looked for at the corners, and between them so many times more, and wherever they
  /// differ; by default everywhere.
  int adaptive = 100;
  bool jitter = false;
  bool circular = false;     ///< squeezed into a disc
  bool orient = false;       ///< turned to what is lit
  bool illumination = false; ///< each place is a light; otherwise only shadows are many
};

struct Light {
  /// Cylinder: parallel light, and none far from the axis.
  enum class Kind : std::uint8_t { Point, Spot, Parallel, Cylinder };
  Span span;
  Kind kind = Kind::Point;
  Vec3 position{0};
  Colour colour{Vec3(1), 0, 0, nullptr};
  Vec3 point_at{0, 0, 1};
  double radius_deg = 30;
  double falloff_deg = 45;
  double radius = 0.75, falloff = 1; ///< of a cylinder
  double tightness = 0;
  std::optional<AreaGrid> area;
  /// It lights only through this object, which no one sees; or null.
  std::shared_ptr<Object const> projected_through;
  std::shared_ptr<Object const> looks_like; ///< placed apart in a finished Scene
  std::uint16_t group = 0; ///< in a finished Scene: number in Scene::light_groups, or 0
  bool shadowless = false;
  LampThrows throws;
  bool media_interaction = true;
  bool media_attenuation = false; ///< fog weakens it
  double fade_distance = 0;
  double fade_power = 0;
};

/// Its lights light only its objects.
struct LightGroup {
  /// Do lights of no group light them too? What the outermost group says counts.
  bool global_lights = false;
  std::uint16_t outer = 0; ///< the group that it stands in, or 0
};

} // namespace abbe::scene
