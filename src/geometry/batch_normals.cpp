// SPDX-License-Identifier: MIT
#include "geometry/batch.hpp"

#include "geometry/world_impl.hpp"

namespace abbe::geometry {

void World::normals(std::size_t count, RayHit const* hits, VectorArrays const& points,
                    VectorArrays const& smoothed, VectorArrays const& geometric) const {
  std::size_t known = count; // the last hit on a face that has one normal
  for (std::size_t k = 0; k < count; ++k) {
    RayHit const& hit = hits[k];
    if (hit.kind == RayHit::Kind::Nothing) continue;
    if (known < count && hits[known].primitive == hit.primitive && hits[known].face == hit.face) {
      smoothed.set(k, smoothed.get(known));
      geometric.set(k, geometric.get(known));
      continue;
    }
    Normals const own = normals(hit.primitive, hit.face, points.get(k));
    smoothed.set(k, own.smoothed);
    geometric.set(k, own.geometric);
    known = flat(hit.primitive, hit.face) ? k : count;
  }
}

} // namespace abbe::geometry
