// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh_walk.hpp"
#include "geometry/shapes/triangle_test.hpp"

#include <array>

namespace abbe::geometry {

/// Corners of the faces of a mesh, as indices.
using Corners = std::array<std::uint32_t, 3>;

/// Looks for the triangles that a line goes through: those of a leaf side by side, in the
/// arithmetic of hit_triangle() up to the signs of the edges.
class TriangleWalk {
public:
  /// @param bvh over the faces in their order
  /// @param from,to counted from the line's point
  TriangleWalk(Bvh const& bvh, ShearedLine const& line, Vec3 const* vertices, Corners const* faces,
               double from)
      : line_(line),
        vertices_(vertices),
        faces_(faces),
        // The hierarchy sees exactly the line that the triangles see.
        probe_(Ray{line.point, line.direction, Vec3(0)}, bvh.space()),
        walk_(bvh, probe_, from) {}

  /// The next face that hit_triangle() may say is hit, of a leaf that begins up to `to`.
  /// @return false: there is none
  bool next(double to, std::uint32_t& face);

private:
  struct Search;
  /// A bit for each of the faces from `first` on, at most as many as L has lanes.
  template <class L>
  unsigned hit(std::uint32_t first, std::uint32_t count) const;

  ShearedLine const& line_;
  Vec3 const* vertices_;
  Corners const* faces_;
  NodeProbe probe_;
  BvhWalk<NodeProbe> walk_;
  BvhWalk<NodeProbe>::Leaf leaf_{0, 0}; ///< what is left of it
  std::uint32_t first_ = 0;             ///< face of the lowest bit of `hits_`
  unsigned hits_ = 0;
};

} // namespace abbe::geometry
