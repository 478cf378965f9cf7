// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "transport/lanes.hpp"
#include "transport/media_stacks.hpp"
#include "transport/rays.hpp"

#include <span>

namespace abbe::transport {

/// The light of a chunk of rays. Arrays that have a value a lane hold the first ray's lanes first.
struct ChunkLight {
  LightKind kind;
  std::size_t each = 0;              ///< lanes of a ray
  bool doubles = false;              ///< lanes of the published scheme
  std::uint32_t slot[chunk_width];   ///< of the film, of the first lane
  std::uint16_t tooth[chunk_width];  ///< of the kind's wave table, of the first lane
  std::uint16_t* channels = nullptr; ///< a lane
  double* light = nullptr;           ///< throughput, a lane

  /// Number of the wavelength of a lane where it is split: of the wave table of the split.
  int tooth_of(std::size_t r, std::size_t c) const {
    return doubles ? channels[r * each + c] : tooth[r] + static_cast<int>(c);
  }
};

/// Rays of one kind that met surfaces that look and refract alike, side by side; and the light that
/// they brought there. What is made of them on the way is added piece by piece.
struct Chunk : ChunkLight {
  std::uint8_t mask = camera_bit; ///< what the rays can see
  std::size_t count = 0;          ///< rays
  std::size_t lanes() const { return count * each; }

  // The rays.
  Vectors direction;
  std::uint16_t level[chunk_width];
  std::uint32_t path[chunk_width]; ///< with Paths
  std::uint32_t sample[chunk_width];
  RandomKey const* jitter = nullptr; ///< of area lights, by sample
  double travelled[chunk_width];     ///< since the last real surface, at the hit; with priorities

  // What they met.
  Vectors point, point_error;
  Vectors normal;    ///< unit shading normal on the side the ray comes from
  Vectors geometric; ///< the true one, same side
  /// Some normal is tilted by the layer on top of the surface (tilt.hpp). Then: that layer's
  /// number, or -1 where it is not; and the normals of the surfaces themselves.
  bool tilts = false;
  std::int32_t tilted[chunk_width];
  Vectors untilted;
  /// Several surfaces that coincide; null: each ray met a surface of its own, `hit`.
  geometry::HitGroup const* group = nullptr;
  geometry::RayHit hit[chunk_width];                    ///< the surface shown
  std::span<geometry::SurfaceCrossing const> crossings; ///< of the group
  std::uint32_t start_group = 0;                        ///< number of the group among starts
  MediaStacks::Id before[chunk_width], after[chunk_width];
  int medium_before = 0, medium_after = 0;

  // What becomes of them (interface.hpp).
  Values cos_i;
  Values n1, n2;
  Values reflectance, transmittance; ///< Fresnel's; 1 and 0 at total reflection
  RaySet total = 0;
  Vectors mirrored, refracted;

  /// What a ray starts from that leaves the surface.
  geometry::RayStart start_of(std::size_t r, bool through) const {
    using Kind = geometry::RayStart::Kind;
    if (group != nullptr) return {start_group, 0, Kind::Group, false, through};
    return {hit[r].primitive, hit[r].face, Kind::Surface, hit[r].was_entering, through};
  }
};

} // namespace abbe::transport
