// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "geometry/world.hpp"
#include "surface/textures.hpp"

#include <array>
#include <optional>
#include <span>

namespace abbe::surface {

/// The layers that a ray meets at a crossing, from the bottom to the top; several, each with its
/// share of the surface, where textures meet on a face.
struct SeenLayers {
  struct Part {
    std::span<int const> layers;
    double share = 1;
  };
  std::array<Part, geometry::FaceBlend::most> part;
  std::size_t count = 1;
};

/// The only reader of layers, faces and interior textures: every ray that meets a surface asks it,
/// whether it is shaded there or tinted on its way to a lamp.
class Reader {
public:
  Reader(Textures const& textures, geometry::World const& world)
      : textures_(textures), world_(world) {}

  /// The layers that all rays see which share this crossing; nullopt: ask at().
  std::optional<std::span<int const>> same(geometry::SurfaceCrossing const& crossing) const;
  /// @param inverse the solid's inside is outside of the crossing's primitive
  /// @param direction of the ray
  SeenLayers at(geometry::SurfaceCrossing const& crossing, bool inverse, Vec3 const& point,
                Vec3 const& direction) const;
  /// Is the inside of a crossing's solid outside of its primitive? @param hit that it is of
  static bool inverse(geometry::HitGroup const& hit, geometry::SurfaceCrossing const& crossing);

  /// Light that passes straight through.
  struct Passing {
    Vec3 point;     ///< where it meets the surface
    Vec3 direction; ///< unit
    std::uint16_t const* channel;
    int lanes;
    double* left; ///< a value a lane
  };
  /// Leaves what the surface lets pass. @param caustics of the solid's interior
  void tint(geometry::SurfaceCrossing const& crossing, bool inverse, double caustics,
            Passing const& light, Arena& arena) const;

private:
  bool from_inside(geometry::SurfaceCrossing const& crossing, bool inverse, Vec3 const& point,
                   Vec3 const& direction) const;
  void tint_by(std::span<int const> layers, double focus, Passing const& light, Arena& arena) const;

  Textures const& textures_;
  geometry::World const& world_;
};

} // namespace abbe::surface
