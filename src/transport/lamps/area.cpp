// SPDX-License-Identifier: MIT
#include "transport/lamps/area.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport {

Area::Axes Area::axes(Vec3 const& way) const {
  if (!grid_.orient) return {grid_.axis1, grid_.axis2};
  constexpr double near = 0.01;
  Vec3 const aside = 1 - std::abs(way.z) < near ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  double const length = glm::length(grid_.axis1);
  Vec3 const first = glm::normalize(glm::cross(way, aside));
  return {length * first, length * glm::normalize(glm::cross(way, first))};
}

Vec3 Area::offset(Axes const& axes, int u, int v, RandomKey const& key) const {
  RandomKey const own = grid_.jitter ? key.child(place(u, v)) : key;
  auto const along = [&](int at, int size, std::uint64_t axis) {
    if (size < 2) return 0.0;
    double const shift = grid_.jitter ? own.uniform(axis) - 0.5 : 0;
    return (at + shift) / (size - 1) - 0.5;
  };
  double x = along(u, grid_.size1, 0), y = along(v, grid_.size2, 1);
  if (grid_.circular) {
    x += 0.001; // so that neither vanishes
    y += 0.001;
    double const squeeze = std::max(std::abs(x), std::abs(y)) / std::sqrt(x * x + y * y);
    x *= squeeze;
    y *= squeeze;
  }
  return axes.first * x + axes.second * y;
}

} // namespace abbe::transport
