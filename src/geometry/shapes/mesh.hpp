// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "geometry/shapes/normal_kernel.hpp"
#include "geometry/shapes/triangle_walk.hpp"

#include <array>
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
class Mesh final : public WithNormalKernel<Mesh> {
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
  template <class L>
  void normal_lanes(lane::Vec<L> const& points, std::uint32_t const* faces,
                    NormalLanes<L>& out) const;
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
  /// A face in the mesh's own space.
  struct FileFace {
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> normals; ///< where `smooth`; of any length
    std::array<Vec2, 3> uv;      ///< 0 without uv
    bool smooth = false;
  };
  /// The faces in the order of the file, but for those without area.
  std::vector<FileFace> faces_of_file() const;
  /// Does each edge (by its ends' places) belong to an even number of faces? A line then crosses
  /// the mesh an even number of times.
  bool closed() const;

private:
  struct Hierarchy {
    std::once_flag once;
    std::atomic<bool> there = false;  ///< as call_once knows, at the price of a load
    Bvh bvh;                          ///< its items are the faces as they then stand
    std::vector<std::uint32_t> order; ///< of each of these: its place in the file
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
  /// Numbers of the normals at the corners of a face.
  Corners const& normals_of(std::uint32_t face) const {
    return data_.normal_corners.empty() ? data_.faces[face] : data_.normal_corners[face];
  }

  mutable MeshData data_; ///< sorted once, when the hierarchy is built
  mutable Hierarchy hierarchy_;
  BvhSpace space_;
  Bounds bounds_;
};

template <class L>
void Mesh::normal_lanes(lane::Vec<L> const& p, std::uint32_t const* faces,
                        NormalLanes<L>& out) const {
  auto const gather = [](std::vector<Vec3> const& from, auto const& number) {
    Vec3 const &a = from[number(0)], &b = from[number(1)], &c = from[number(2)],
               &d = from[number(3)];
    return lane::Vec<L>{L(a.x, b.x, c.x, d.x), L(a.y, b.y, c.y, d.y), L(a.z, b.z, c.z, d.z)};
  };
  auto const vertices = [&](std::size_t corner) {
    return gather(data_.vertices, [&](int k) { return data_.faces[faces[k]][corner]; });
  };
  lane::Vec<L> const a = vertices(0), b = vertices(1), c = vertices(2);
  lane::Vec<L> const across = cross(b - a, c - a);
  lane::Vec<L> const flat = unit_lanes(across, out.unclear);
  out.smoothed = out.geometric = flat;
  if (!smoothed()) return;
  auto const smooth = [&](int k) { return normals_of(faces[k])[0] != MeshData::flat; };
  auto const is = [&](int k) { return smooth(k) ? 1.0 : 0.0; };
  auto const normals = [&](std::size_t corner) {
    return gather(data_.normals,
                  [&](int k) { return smooth(k) ? normals_of(faces[k])[corner] : 0U; });
  };
  // As corner_weights().
  L const area2 = lane::dot(across, across);
  L const wa = lane::dot(cross(b - p, c - p), across) / area2;
  L const wb = lane::dot(cross(c - p, a - p), across) / area2;
  lane::Vec<L> const sum = wa * normals(0) + wb * normals(1) + (L(1.0) - wa - wb) * normals(2);
  auto const smoothed_here = L(0.0) < L(is(0), is(1), is(2), is(3));
  auto unclear = out.unclear;
  lane::Vec<L> const shown = unit_lanes(sum, unclear);
  out.unclear = lane::either(out.unclear, lane::both(smoothed_here, unclear));
  out.smoothed = {lane::select(smoothed_here, shown.x, flat.x),
                  lane::select(smoothed_here, shown.y, flat.y),
                  lane::select(smoothed_here, shown.z, flat.z)};
}

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
