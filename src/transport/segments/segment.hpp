// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"
#include "scene/scene.hpp"
#include "surface/textures.hpp"
#include "transport/lanes.hpp"

#include <memory>
#include <vector>

namespace abbe::transport {

/// Light on its way through a medium.
struct Passage {
  std::size_t rays = 0, each = 0;   ///< lanes a ray
  std::uint16_t const* channel;     ///< a lane
  double const* distance = nullptr; ///< a ray, in scene units; may be infinite
  double* light = nullptr;          ///< a lane
  bool to_lamp = false;             ///< from a lamp, not to the camera
};

/// What a medium does to light. A new effect: a file here, and a line in segments.cpp.
class Segment {
public:
  virtual ~Segment() = default;
  /// Along a piece of its way.
  virtual void along(Passage const&) const {}
  /// Where it leaves the medium, having gone that far in it.
  virtual void leave(Passage const&) const {}
  /// Does leave() do anything?
  virtual bool acts_where_left() const { return false; }
};

using Segments = std::vector<std::unique_ptr<Segment const>>;

/// What an interior's medium does.
/// @param absorption per scene unit and channel; empty: none
/// @param fade_colour by channel
Segments make_segments(scene::Interior const& interior, surface::Channels absorption,
                       surface::Channels fade_colour, bool fades);

} // namespace abbe::transport
