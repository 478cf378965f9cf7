// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace abbe::transport::caustics {

/// A square of the emission of a lamp: 2^level on a side of a face.
struct Cell {
  int face = 0, level = 0;
  std::uint32_t i = 0, j = 0;
  double size() const { return 2.0 / static_cast<double>(std::uint32_t{1} << level); }
  Vec2 low() const { return Vec2(-1) + size() * Vec2(i, j); }
  Vec2 high() const { return low() + Vec2(size()); }
  Cell parent() const { return {face, level - 1, i / 2, j / 2}; }
  bool operator==(Cell const&) const = default;
};

/// A ray behind the last step of a chain.
struct BeamRay {
  Vec3 origin{0}, direction{0};
};

/// Light of a chain from one cell: its rays at three by three places of the cell, at both ends of
/// a piece of the spectrum (the same twice where the chain does not disperse). All rays between
/// these are the sheet's beam.
struct Sheet {
  int lamp = 0, chain = 0;
  Cell cell;
  /// The piece of the spectrum, of which 0 .. 1 is all (Caustics::place_of): so small that rays
  /// between its ends are between the rays at its ends.
  double from = 0, to = 1;
  /// What the nodes count from: two axes across the beam, and along it.
  Vec3 middle{0}, across{0}, up{0}, along{0};
  /// Rays of the nodes by where they pass the plane of the axes, and by how they go on along the
  /// beam; the first nine at one end of the spectrum, then those at the other.
  std::array<float, 18> x, y, slope_x, slope_y;
  /// Where it begins and ends, along it from `middle`: no surface is farther.
  double near = 0, far = 0;
  double length = 0; ///< of its longest ray
  /// As large as the largest piece of the emission in it that all comes through.
  double grain = 0;
  double flux = 0; ///< that it carries, of the lamp's in units of the emission
  /// By how much rays of the cell are outside of a rectangle around the nodes, as a share of it.
  float margin = 0.25F;
  double power = 0; ///< what its strongest ray has left of the lamp's light
  /// Nothing is in the way of its rays, which all make the chain, and their map tells their light.
  bool certain = false;
  std::int32_t map = -1; ///< number of the BeamMap that tells its rays; -1: none does

  /// Nodes' rays where the beam is `ahead` long, relative to a point.
  Vec3 at(std::size_t node, double ahead) const {
    return middle + ahead * along + (x[node] + ahead * slope_x[node]) * across
           + (y[node] + ahead * slope_y[node]) * up;
  }
  /// @param rays nine at each end; all go forward along the mean of the first nine
  /// @pre length: the axes lie as the beam does there
  void set(std::array<std::array<BeamRay, 9>, 2> const& rays);
};

/// The eight triangles that the nodes of a sheet make: numbers of three nodes each, turning alike.
inline constexpr std::array<std::array<int, 3>, 8> sheet_triangles{
    {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}}};
/// Where a node is in its cell, of which a side is 2.
inline Vec2 node_place(int node) {
  return {node % 3, node / 3};
}

/// Two unit vectors across a direction.
std::pair<Vec3, Vec3> axes_across(Vec3 const& direction);

} // namespace abbe::transport::caustics
