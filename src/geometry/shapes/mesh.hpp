// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "geometry/shape.hpp"
#include "geometry/shapes/triangle_walk.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace abbe::geometry {

/// What a mesh is made of. Index lists that are empty: normals or uv have the same corners as the
/// faces when there are normals or uv at all.
struct MeshData {
  std::vector<Vec3> vertices;
  std::vector<Corners> faces;
  std::vector<Vec3> normals;           ///< need not be of unit length
  std::vector<Corners> normal_corners; ///< per face; a corner of `flat` in the first: not smoothed
  std::vector<Vec2> uv;
  std::vector<Corners> uv_corners;
  std::vector<std::array<std::int32_t, 3>> textures; ///< per face, of its corners; empty: none
  std::optional<Vec3> inside_vector;
  bool lone = false; ///< one triangle, by a statement of its own
  static constexpr std::uint32_t flat = 0xffffffff;
};

/// Triangles with their own hierarchy, in a space where the largest extent is in [1, 2) about the
/// origin (a power of two: scaling a mesh changes no bit of it).
///
/// With an inside_vector the mesh is solid: crossings along a line alternate between entering and
/// leaving, starting outside at -infinity. Without, each triangle is a patch. The hierarchy is
/// built when something is looked for in it for the first time. Face numbers are those of the
/// hierarchy, not of the file.
class Mesh final : public Shape {
public:
  /// @param data indices valid, no face degenerate (make_mesh sees to it)
  explicit Mesh(MeshData data);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Vec3 geometric_normal(Vec3 const& point, std::uint32_t face) const override;
  bool smoothed() const override { return !data_.normals.empty(); }
  Side side() const override {
    return data_.lone && data_.normals.empty() ? Side::FacingByAxis : Side::Facing;
  }
  /// As in POV-Ray: a smoothed normal where the corners' differ, else the side from which the
  /// corners run counter-clockwise (x to the right, y up, seen along +z).
  Vec3 facing(Vec3 const& point, std::uint32_t face) const override;
  bool flat(std::uint32_t) const override { return data_.normals.empty(); }
  Bounds bounds() const override { return bounds_; }
  bool solid() const override { return data_.inside_vector.has_value(); }
  int face_texture(std::uint32_t face) const override;
  std::optional<FaceBlend> face_blend(Vec3 const& point, std::uint32_t face) const override;
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;
  std::size_t memory() const; ///< bytes, for the tests
  /// Does each edge (by its ends' places) belong to an even number of faces? A line then crosses
  /// the mesh an even number of times.
  bool closed() const;

private:
  struct Hierarchy {
    std::once_flag once;
    std::atomic<bool> there = false; ///< as call_once knows, at the price of a load
    Bvh bvh;                         ///< its items are the faces as they then stand
  };
  struct Extent {
    Vec3 low, high;
  };
  Extent extent(Corners const& face) const;
  Bvh const& hierarchy() const;
  void build() const;
  template <class T>
  static void permute(std::vector<T>& items, std::vector<std::uint32_t> const& order);
  template <class Visit>
  void each_hit(ShearedLine const& line, double from, double const& to, Visit&& visit) const;
  Vec3 weights(Vec3 const& point, std::uint32_t face) const;

  mutable MeshData data_; ///< sorted once, when the hierarchy is built
  mutable Hierarchy hierarchy_;
  BvhSpace space_;
  Bounds bounds_;
};

/// Can a line enter the shape without leaving it again? (a solid mesh that is not closed)
bool leaks(Shape const& shape);

/// What was wrong with the input of a mesh and what came of it.
struct MeshResult {
  std::optional<PlacedShape> shape; ///< none: nothing to draw
  std::size_t degenerate = 0;       ///< faces without area that were dropped
};
/// Drops degenerate faces, moves and scales to canonical form. @param data indices valid, finite
MeshResult make_mesh(MeshData data);

} // namespace abbe::geometry
