// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "scene/scene.hpp"

#include <cstddef>

namespace abbe::transport {

/// The places of an area light, as vectors from the middle of it.
/// @source POV-Ray's documentation, 3.4.7.4 (area light); what its program shows
class Area {
public:
  explicit Area(scene::AreaGrid const& grid) : grid_(grid) {}

  scene::AreaGrid const& grid() const { return grid_; }
  std::size_t places() const {
    return static_cast<std::size_t>(grid_.size1) * static_cast<std::size_t>(grid_.size2);
  }
  std::size_t place(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(grid_.size1)
           + static_cast<std::size_t>(u);
  }
  /// Its edges, as they are turned.
  struct Axes {
    Vec3 first, second;
  };
  /// @param way unit, from what is lit to the middle
  Axes axes(Vec3 const& way) const;
  /// @param key of the sample and the lamp: what `jitter` shifts by
  Vec3 offset(Axes const& axes, int u, int v, RandomKey const& key) const;

private:
  scene::AreaGrid grid_;
};

} // namespace abbe::transport
