// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"
#include "geometry/shapes/triangle_test.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace abbe::geometry {

/// Heights at the points of a grid, in 1/65536 of the unit box.
struct HeightGrid {
  int columns = 0, rows = 0;          ///< points, at least 2 each
  std::vector<std::uint16_t> heights; ///< x fastest, the row at z = 0 first
  std::uint16_t at(int i, int j) const {
    return heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns)
                   + static_cast<std::size_t>(i)];
  }
};

/// The least and largest heights of blocks of a grid, and of blocks of blocks.
struct HeightBlocks {
  static constexpr int side = 4; ///< cells along a side of the smallest blocks
  struct Range {
    std::uint16_t low, high;
  };
  struct Level {
    int columns, rows;
    std::vector<Range> ranges;
  };
  std::vector<Level> levels; ///< from the smallest blocks to one
  explicit HeightBlocks(HeightGrid const& grid);
};

/// A surface of triangles over the unit square of x and z, seen above the water level. Inside is
/// below it, down to the water; of a `deep` one without an end, also where it is not seen, as in
/// POV-Ray. Sides and bottom are not seen.
///
/// Canonical form: cells of size 1 about the origin, heights scaled by a power of two to the size
/// of the longer side. Each cell is two triangles, parted from <1, 0> to <0, 1>; watertight as
/// meshes are. Faces: 2 cell + upper half, then the walls -x, +x, -z, +z and the water. A pyramid
/// of least and largest heights of blocks says which cells a line comes near.
class HeightField final : public Shape {
public:
  /// @param water height of the water in the unit box
  struct Form {
    bool smooth = false;
    bool deep = false; ///< what is below its box counts as inside
    double water = 0;  ///< level of the water in the unit box
  };
  HeightField(HeightGrid grid, Form const& form);
  Form const& form() const { return form_; }
  /// The same as part of a combination.
  std::shared_ptr<HeightField const> deepened() const;
  /// The same where its inverse placement is known: smooth normals are means of what the normals at
  /// the points of the grid are there.
  std::shared_ptr<HeightField const> placed(Mat3 const& inverse_linear) const;
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Vec3 geometric_normal(Vec3 const& point, std::uint32_t face) const override;
  bool smoothed() const override { return form_.smooth; }
  bool flat(std::uint32_t) const override { return !form_.smooth; }
  Boundary boundary() const override { return Boundary::Open; }
  Bounds bounds() const override { return bounds_; }
  double ball_radius() const override { return form_.deep ? infinite_ : ball_; }
  void half_spaces(std::vector<HalfSpace>& out) const override;
  /// x and y in the unit box.
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;

  /// Of one unit of height in canonical form.
  static double unit_of(int columns, int rows);

private:
  struct Box; ///< what a line has in common with the box
  struct Walk;
  double y_of(int height) const { return (height - 32768) * unit_; }
  Vec3 vertex(int i, int j) const { return {i - middle_x_, y_of(grid_->at(i, j)), j - middle_z_}; }
  void corners(std::uint32_t face, Vec3 (&corner)[3]) const;
  std::uint32_t cells() const {
    return static_cast<std::uint32_t>(grid_->columns - 1)
           * static_cast<std::uint32_t>(grid_->rows - 1);
  }
  void find_bounds();
  Vec3 vertex_normal(int i, int j) const;
  bool below(Vec3 const& point) const;
  bool box_of(Ray const& ray, Box& box) const;
  /// Orders the hits, and adds where the box is entered or left inside.
  void finish(Ray const& ray, Box const& box, std::size_t first, Crossings& out) const;

  static constexpr double infinite_ = std::numeric_limits<double>::infinity();
  std::shared_ptr<HeightGrid const> grid_;
  std::shared_ptr<HeightBlocks const> blocks_;
  Form form_;
  Mat3 inverse_; ///< of the placement, to see the lengths of normals
  double unit_, middle_x_, middle_z_, water_ = 0, bottom_ = 0, top_ = 0;
  Bounds bounds_;
  double ball_ = 0;
};

/// In the unit box. @param water its level there. @return nullopt: nothing is above the water
std::optional<PlacedShape> make_height_field(HeightGrid grid, bool smooth, double water);

} // namespace abbe::geometry
