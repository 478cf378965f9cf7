// SPDX-License-Identifier: MIT
#include "geometry/batch.hpp"
#include "geometry/shapes/normal_kernel.hpp"
#include "geometry/world_impl.hpp"
#include "simd/native.hpp"

#include <algorithm>

/// Normals of many hits.
namespace abbe::geometry {

namespace {

constexpr std::size_t width = 4;

/// Up to `width` hits of one primitive.
struct FindNormals {
  template <class L>
  static void run(Placed const& placed, NormalKernel const& kernel, std::size_t count,
                  RayHit const* hits, VectorArrays const& points, VectorArrays const& smoothed,
                  VectorArrays const& geometric) {
    std::uint32_t faces[width];
    Vec3 point[width];
    for (std::size_t k = 0; k < width; ++k) {
      std::size_t const own = std::min(k, count - 1);
      faces[k] = hits[own].face;
      point[k] = points.get(own);
    }
    auto const axis = [&](int i) { return L(point[0][i], point[1][i], point[2][i], point[3][i]); };
    NormalLanes<L> found;
    kernel.normals(placed.to_object(lane::Vec<L>{axis(0), axis(1), axis(2)}), faces, found);
    write(placed.to_unit_world_normals(found.smoothed), count, smoothed);
    if (placed.shape().smoothed())
      write(placed.to_unit_world_normals(found.geometric), count, geometric);
    else
      for (std::size_t k = 0; k < count; ++k) geometric.set(k, smoothed.get(k));
    if (lane::none(found.unclear)) return;
    for (std::size_t k = 0; k < count; ++k) {
      smoothed.set(k, placed.normal(faces[k], point[k], false));
      geometric.set(k, placed.normal(faces[k], point[k], true));
    }
  }
  template <class L>
  static void write(lane::Vec<L> const& normals, std::size_t count, VectorArrays const& out) {
    double values[3][width];
    lane::store(values[0], normals.x);
    lane::store(values[1], normals.y);
    lane::store(values[2], normals.z);
    for (std::size_t k = 0; k < count; ++k) out.set(k, {values[0][k], values[1][k], values[2][k]});
  }
};

} // namespace

void World::normals(std::size_t count, RayHit const* hits, VectorArrays const& points,
                    VectorArrays const& smoothed, VectorArrays const& geometric) const {
  static constexpr simd::Native<FindNormals, width> find;
  auto const met = [&](std::size_t k) { return hits[k].kind != RayHit::Kind::Nothing; };
  for (std::size_t k = 0, next = 0; k < count; k = next) {
    next = k + 1;
    if (!met(k)) continue;
    RayHit const& hit = hits[k];
    auto const with = [&](std::size_t other) {
      return other < count && met(other) && hits[other].primitive == hit.primitive;
    };
    Placed const& placed = impl_->primitives[hit.primitive];
    NormalKernel const* const kernel = placed.shape().normal_kernel();
    bool const flat = placed.shape().flat(hit.face);
    if (kernel != nullptr && with(next) && !(flat && hits[next].face == hit.face)) {
      while (next < k + width && with(next)) ++next;
      find(placed, *kernel, next - k, hits + k, points.from(k), smoothed.from(k),
           geometric.from(k));
      continue;
    }
    Normals const own = normals(hit.primitive, hit.face, points.get(k));
    for (next = k; next == k || (flat && with(next) && hits[next].face == hit.face); ++next) {
      smoothed.set(next, own.smoothed);
      geometric.set(next, own.geometric);
    }
  }
}

} // namespace abbe::geometry
