// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "geometry/world.hpp"
#include "surface/textures.hpp"

#include <optional>
#include <span>

namespace abbe::surface {

/// The layers that a ray meets at a crossing, from the bottom to the top; several, each with its
/// share of the surface, where textures meet on a face or patterns mix them.
struct SeenLayers {
  struct Part {
    std::span<int const> layers;
    double share = 1;
    /// The textures lie in the space of a pattern that chose them: the place there, and the linear
    /// part of the way there.
    bool placed = false;
    Vec3 point{0};
    Mat3 linear{1};
  };
  std::span<Part const> parts; ///< at least one, in the arena that they were asked for with
};

/// The only reader of layers, faces, patterned textures and interior textures: every ray that meets
/// a surface asks it, whether it is shaded there or tinted on its way to a lamp.
class Reader {
public:
  Reader(Textures const& textures, geometry::World const& world)
      : textures_(textures), world_(world) {}

  /// A ray that meets a surface.
  struct Meeting {
    geometry::SurfaceCrossing crossing;
    bool inverse; ///< the solid's inside is outside of the crossing's primitive
    Vec3 point;
    texture::Sight sight;
  };
  /// The layers that all rays see which share this crossing; nullopt: ask at().
  std::optional<std::span<int const>> same(geometry::SurfaceCrossing const& crossing) const;
  SeenLayers at(Meeting const& meeting, Arena& arena) const;
  /// Is the inside of a crossing's solid outside of its primitive? @param hit that it is of
  static bool inverse(geometry::HitGroup const& hit, geometry::SurfaceCrossing const& crossing);
  /// The surface's own coordinates at a point.
  Vec2 uv(geometry::PrimitiveId primitive, std::uint32_t face, Vec3 const& point) const;

  /// The normal of a surface on the side that a ray comes from.
  Vec3 facing(geometry::SurfaceCrossing const& crossing, Vec3 const& point,
              Vec3 const& direction) const;

  /// Light that passes straight through.
  struct Passing {
    std::uint16_t const* channel;
    int lanes;
    double* left; ///< a value a lane
  };
  /// Leaves what the surface lets pass. @param caustics of the solid's interior
  void tint(Meeting const& meeting, double caustics, Passing const& light, Arena& arena) const;

private:
  bool from_inside(Meeting const& meeting) const;
  /// Adds the textures that lie there, each with its share.
  void resolve(SeenLayers::Part const& part, Meeting const& meeting,
               std::vector<SeenLayers::Part>& out) const;
  void tint_by(SeenLayers::Part const& part, Meeting const& meeting, double focus,
               Passing const& light, Arena& arena) const;

  Textures const& textures_;
  geometry::World const& world_;
};

} // namespace abbe::surface
