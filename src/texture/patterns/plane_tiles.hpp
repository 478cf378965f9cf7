// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace abbe::texture {

/// Tiles that fill the plane and repeat: coordinates are (a + b sqrt(root)) / 4.
struct PlaneTiles {
  struct Number {
    int a, b;
    double value(int root) const { return (a + b * std::sqrt(root)) / 4; }
  };
  struct Point {
    Number x, z;
  };
  struct Tile {
    int type;
    std::vector<Point> corners; ///< convex, counter-clockwise
    /// Edges, by the corner that they begin at, whose bevels are wider by 1 / cos 30 degrees.
    std::vector<std::size_t> wide{};
  };
  int types;
  int root;
  Point across, along; ///< all repeats by these
  std::vector<Tile> tiles;
};

/// Those of `tiling` 1, 2 ...
std::span<PlaneTiles const> plane_tiles();

} // namespace abbe::texture
