// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/placement.hpp"
#include "geometry/shape_ptr.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/// Shapes in their own (object) space, and the crossings of a line with their surface.
///
/// Everything here is without absolute tolerances: a crossing carries the bound of its own rounding
/// error, roots known to be at the ray's start are deflated rather than stepped over, and there is
/// no largest distance. Scaling a scene by a power of two gives the same bits.
namespace abbe::geometry {

/// A line with a start: p(t) = origin + t direction. The direction need not be of unit length (it
/// is not after a transform: t keeps its meaning across spaces).
struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};
  /// How far, per component, the origin may be from the surface point it is meant to be (a hit's
  /// point_error); zero where it is exact. Only decides what is "at the start": the line that is
  /// followed is the one given, so that errors do not grow from bounce to bounce.
  Vec3 origin_error{0};
  /// Bounds of the rounding errors of a transform to object space; leave zero in world space.
  Vec3 origin_rounding{0};
  Vec3 direction_rounding{0};
};

/// Where the line passes through the surface of a shape.
struct Crossing {
  double t = 0;
  double error = 0;       ///< bound of the rounding error of t, for the line as given
  double slack = 0;       ///< how far t moves when the origin moves within its origin_error; not of
                          ///< convex shapes, which find a start without it
  std::uint32_t face = 0; ///< which face, triangle or sheet: for normals, textures and departures
  bool entering = false;  ///< the line goes from outside to inside (against the outward normal)
  bool toggles = true;    ///< inside and outside change here (false: a patch without an inside)
  bool visible = true;    ///< there is a surface here (false: the missing lid of an open cylinder)
};
using Crossings = std::vector<Crossing>;

/// The ray starts on this shape: at this face, and goes on to its inside or its outside.
struct Start {
  std::uint32_t face = 0;
  bool to_inside = false;
};

/// Textures that meet on a face (those of the corners of a triangle, of the components of a blob)
/// and their shares at a point (they add up to 1).
struct FaceBlend {
  static constexpr std::size_t most = 8;
  std::array<int, most> texture;
  std::array<double, most> share;
  std::size_t count = 0;
};

struct Bounds {
  Vec3 low{1, 1, 1};
  Vec3 high{-1, -1, -1};
  bool infinite = false;
  bool empty() const { return !infinite && (low.x > high.x || low.y > high.y || low.z > high.z); }
};

/// The points p with normal . p <= most.
struct HalfSpace {
  Vec3 normal;
  double most;
};

class EndsKernel;
class GapKernel;
class NormalKernel;

/// How much of its own boundary a shape shows.
enum class Boundary : std::uint8_t {
  Whole, ///< all around its inside
  Open,  ///< parts are missing (the lids of an open cylinder): rays come in without meeting it
  Sheet, ///< no volume: patches, and discs, whose inside is for boolean operations only
};
/// By what the side is told from which a surface is seen.
enum class Side : std::uint8_t {
  Crossing,     ///< by the crossing: from outside where it is entered
  Facing,       ///< by facing()
  FacingByAxis, ///< by facing() turned round so that its largest component in the world is -x, +y
                ///< or -z: a flat triangle in a statement of its own, as in POV-Ray
};

class Shape {
public:
  virtual ~Shape() = default;

  /// Appends ALL crossings of the whole line, t from -infinity to +infinity, in any order. When
  /// `start` is given, the ray's origin lies on the surface at that face: the root there is known,
  /// is reported as t == 0 with the origin's error (in units of t), and is removed from the
  /// equation before the others are computed.
  virtual void crossings(Ray const& ray, Start const* start, Crossings& out) const = 0;
  /// Is the point inside the solid? (false for patches)
  virtual bool inside(Vec3 const& point) const = 0;
  /// Outward unit normal at a point of a face; smoothed where the shape says so.
  virtual Vec3 normal(Vec3 const& point, std::uint32_t face) const = 0;
  /// The plane's own normal where normal() is smoothed; equal to normal() else.
  virtual Vec3 geometric_normal(Vec3 const& point, std::uint32_t face) const {
    return normal(point, face);
  }
  /// geometric_normal() is another than normal().
  virtual bool smoothed() const { return false; }
  /// By what the side is told from which a face is seen (for interior_texture).
  virtual Side side() const { return Side::Crossing; }
  /// Normal towards the side that counts as outside where side() is not Crossing; need not be of
  /// unit length.
  virtual Vec3 facing(Vec3 const& point, std::uint32_t face) const { return normal(point, face); }
  /// The face has one normal, wherever the point.
  virtual bool flat(std::uint32_t) const { return false; }
  virtual Bounds bounds() const = 0;
  /// Has an inside (everything but triangles and meshes without inside_vector).
  virtual bool solid() const { return true; }
  virtual Boundary boundary() const { return solid() ? Boundary::Whole : Boundary::Sheet; }
  /// Number of the face's own texture (Parameters::face_texture), -1 for the object's.
  virtual int face_texture(std::uint32_t) const { return -1; }
  /// Where several textures meet on a face; face_texture() is the first of them.
  virtual std::optional<FaceBlend> face_blend(Vec3 const&, std::uint32_t) const {
    return std::nullopt;
  }
  /// The shape's own surface coordinates at a point, where it has them.
  virtual std::optional<Vec2> uv(Vec3 const&, std::uint32_t) const { return std::nullopt; }
  /// A line is inside along one interval or not at all, and crossings() gives its (finite) ends.
  virtual bool one_interval() const { return false; }
  /// The shape as a kernel without lists (shapes/convex.hpp), where it is one.
  virtual EndsKernel const* ends_kernel() const { return nullptr; }
  /// What can be seen of it as a kernel, for a solid of it alone, where ends_kernel() knows more.
  virtual EndsKernel const* surface_kernel() const { return nullptr; }
  /// The shape as a kernel of two roots (shapes/gap_kernel.hpp), where it is no convex one.
  virtual GapKernel const* gap_kernel() const { return nullptr; }
  /// Appends half-spaces that hold all of its inside, where bounds() are infinite: together with
  /// others they may be finite.
  virtual void half_spaces(std::vector<HalfSpace>& /*out*/) const {}
  /// The shape's normals for several points at once (shapes/normal_kernel.hpp), where it has them.
  virtual NormalKernel const* normal_kernel() const { return nullptr; }
  /// A line that keeps clear of this ball about the middle of bounds() has no crossings; "clear" by
  /// a share of 2^-44 of the radius and of the distance, which the kernel's roundings stay under.
  /// Infinite where there is no such ball.
  virtual double ball_radius() const { return std::numeric_limits<double>::infinity(); }
  /// crossings(), but crossings behind the start or beyond the first by more than their errors, and
  /// such that begin after `until`, may be left out.
  virtual void crossings_ahead(Ray const& ray, Start const* start, double /*until*/,
                               Crossings& out) const {
    crossings(ray, start, out);
  }
};

/// A shape and where it stands: shapes are in canonical form (unit sphere, unit cube ...), what
/// makes them this sphere or box is the placement.
struct PlacedShape {
  ShapePtr shape;
  Placement placement;
};

} // namespace abbe::geometry
