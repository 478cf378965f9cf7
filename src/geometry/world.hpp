// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <cstdint>
#include <memory>
#include <vector>

/// All solids of a scene, and what a ray meets first.
namespace abbe::geometry {

using PrimitiveId = std::uint32_t;
using SolidId = std::uint32_t;

/// Boolean tree over primitives. `Clip`: the first child, shown only inside all the others, without
/// caps. `Merge` is the regularised union (a POV-Ray union that must keep its inner faces is
/// several solids, or is distributed over by the caller).
struct CsgTree {
  enum class Op : std::uint8_t { Primitive, Merge, Intersection, Difference, Clip };
  Op op = Op::Primitive;
  PrimitiveId primitive = 0;
  bool inverse = false; ///< inside and outside swapped
  std::vector<CsgTree> children;
};

/// For which rays a solid is there at all.
struct Visibility {
  std::uint8_t mask = 0xff;
};
inline constexpr std::uint8_t visible_to_camera = 1, visible_to_reflection = 2,
                              visible_to_shadow = 4;

/// One solid's surface, passed at a place where a ray goes through.
struct SurfaceCrossing {
  SolidId solid = 0;
  PrimitiveId primitive = 0; ///< whose surface (and so whose texture) is seen
  std::uint32_t face = 0;
  double t = 0;
  bool entering = false; ///< into the solid
  bool toggles = true;   ///< false for patches: nothing is entered or left
};

/// The primitives on whose surface a ray starts (all that took part in the group of crossings it
/// comes from, also those whose surface vanished there), and to which side of each it goes.
struct Departure {
  struct On {
    PrimitiveId primitive = 0;
    std::uint32_t face = 0;
    bool was_entering = false; ///< the arriving ray was entering this primitive
  };
  std::vector<On> on;
  bool through = true; ///< goes on to the other side (transmitted); false: comes back (reflected)
  void clear() { on.clear(); }
};

/// Crossings that are one event within their rounding errors, ordered by solid.
struct HitGroup {
  double t = 0;
  double error = 0;
  Vec3 point{0};
  Vec3 point_error{0}; ///< bound of each component's rounding error
  std::vector<SurfaceCrossing> crossings;
  std::vector<Departure::On> members;
  void clear() {
    crossings.clear();
    members.clear();
  }
};

struct RayLines; // of batch.hpp
struct RayHit;
struct Hits;
struct VectorArrays;

/// Scratch memory of one thread: nothing is allocated per ray once it has grown.
class Scratch;
struct ScratchDeleter {
  void operator()(Scratch*) const;
};
using ScratchPtr = std::unique_ptr<Scratch, ScratchDeleter>;

class World {
public:
  struct Solid {
    CsgTree tree;
    std::uint8_t mask = 0xff;
    bool joins = false; ///< a medium: may be in contact with others (Contacts)
  };
  /// @param primitives placed shapes, index = PrimitiveId, in coordinates relative to the camera
  /// @param solids index = SolidId
  /// @param contact share of the extent that counts as contact of solids that join; 0: none
  World(std::vector<PlacedShape> const& primitives, std::vector<Solid> const& solids,
        double contact = 0);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  static ScratchPtr make_scratch();

  /// The first group of crossings with t > 0 (beyond the departure's own group), of solids with a
  /// bit of `mask`. @return false when the ray meets nothing before t_max
  /// Where the ray leaves one solid and the next that it meets is in contact with that one, both
  /// are one group, at the surface that is left.
  bool closest(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max, Scratch&,
               HitGroup& out) const;
  /// Does any solid with a bit of `mask` cut the open interval (0, t_max)?
  bool occluded(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                Scratch&) const;
  /// closest() for each ray of a batch (batch.hpp), with the bits of each alone.
  /// @param t_max by ray; null: infinite
  void intersect(RayLines const& rays, std::uint8_t mask, double const* t_max, Scratch&,
                 Hits& hits) const;
  /// occluded() for each ray of a batch. @param blocked 1 or 0 by ray
  void occluded(RayLines const& rays, std::uint8_t mask, double const* t_max, Scratch&,
                std::uint8_t* blocked) const;
  /// The solids that contain the point, ordered by where a fixed line through it entered them.
  void containing(Vec3 const& point, Scratch&, std::vector<SolidId>& out) const;
  /// Outward unit normal of the primitive's surface in world space (smoothed / the true one).
  Vec3 normal(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  Vec3 geometric_normal(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  /// Both: most shapes have one only.
  struct Normals {
    Vec3 smoothed, geometric;
  };
  Normals normals(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  /// The same for many hits, each at its point; nothing is written for those that met nothing.
  void normals(std::size_t count, RayHit const* hits, VectorArrays const& points,
               VectorArrays const& smoothed, VectorArrays const& geometric) const;
  /// Unit normal towards what counts as outside, where Shape::side() is not Crossing.
  Vec3 facing(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  /// Is the point inside the primitive?
  bool inside(PrimitiveId, Vec3 const& point) const;
  Bounds bounds(SolidId) const;
  /// Appends the solids whose bounds meet a box, and some perhaps whose bounds do not.
  void meeting(Vec3 const& low, Vec3 const& high, std::vector<SolidId>& out) const;
  /// The primitive that a solid consists of, where it is one alone.
  std::optional<PrimitiveId> lone(SolidId) const;
  /// Of a face whose corners have different textures: these, and their shares at the point.
  std::optional<FaceBlend> face_blend(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  /// The primitive's own surface coordinates at a point; x and y of its space where it has none.
  Vec2 uv(PrimitiveId, std::uint32_t face, Vec3 const& point) const;
  Shape const& shape(PrimitiveId) const;
  /// Where lines meet the surface of one primitive, whatever else is there and whether boolean
  /// operations have left that surface or not: the first crossing ahead that goes the same way.
  /// @param starts by line, its place on the primitive, where all depart from it; or null
  /// @param entering the primitive
  /// @param t by line, room for whole lanes; not above 0: there is none @param face by line
  void crossings_of(PrimitiveId, std::size_t count, VectorArrays const& origins,
                    VectorArrays const& directions, Start const* starts, bool entering, Scratch&,
                    double* t, std::uint32_t* face) const;

  struct Impl; ///< of this folder's own

private:
  friend class WorldBuilder; // which makes large ones
  explicit World(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

} // namespace abbe::geometry
