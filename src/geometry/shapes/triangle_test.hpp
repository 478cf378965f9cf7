// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"

#include <optional>

/// A line against triangles without gaps or double hits at shared edges and vertices (Woop,
/// Benthin, Wald 2013): all triangles are sheared into the plane across the line by the same
/// function of a vertex, and the sign of an edge there is exact. A point on an edge or vertex is
/// moved off it by (epsilon, epsilon^2) in thought: of all triangles that fill the plane around it,
/// one is hit.
namespace abbe::geometry {

/// A line sheared so that it is the z axis.
struct ShearedLine {
  explicit ShearedLine(Line<double> const& line);
  Vec3 point;    ///< near the closest approach to the origin of the object space
  Vec3 rounding; ///< of it
  double t = 0;  ///< of the point
  Vec3 direction, direction_rounding, slack;
  int kx = 0, ky = 1, kz = 2; ///< kz: the longest component of the direction
  double sx = 0, sy = 0, sz = 0;
};

struct TriangleHit {
  double t = 0, error = 0, slack = 0;
  bool against_normal = false; ///< the direction is against the normal (b - a) x (c - a)
  bool downward = false;       ///< the same, by the exact signs of the edges
};
std::optional<TriangleHit> hit_triangle(ShearedLine const& line, Vec3 const& a, Vec3 const& b,
                                        Vec3 const& c);

/// Weights of the corners at a point of the triangle's plane.
Vec3 corner_weights(Vec3 const& point, Vec3 const& a, Vec3 const& b, Vec3 const& c);

} // namespace abbe::geometry
