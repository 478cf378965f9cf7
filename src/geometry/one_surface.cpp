// SPDX-License-Identifier: MIT
#include "geometry/scratch.hpp"
#include "geometry/shapes/convex.hpp"
#include "geometry/world_impl.hpp"
#include "simd/native.hpp"

#include <algorithm>

/// Lines and the surface of one primitive alone.
namespace abbe::geometry {
namespace {

struct CrossConvex {
  template <class L>
  static void run(Placed const& placed, EndsKernel const& kernel, std::size_t count,
                  VectorArrays const& origins, VectorArrays const& directions, Start const* start,
                  bool entering, double* t, double* face) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      auto const load = [k](VectorArrays const& v) {
        return lane::Vec<Lanes>{lane::load<Lanes>(v.x + k), lane::load<Lanes>(v.y + k),
                                lane::load<Lanes>(v.z + k)};
      };
      Ends<Lanes> ends;
      kernel.ends(placed.line<Lanes>(load(origins), load(directions)), start, ends);
      Lanes const zero(0.0), far(infinity);
      Lanes const at = entering ? ends.in_t : ends.out_t;
      auto const met = lane::both(ends.in_t < ends.out_t, lane::both(zero < at, at < far));
      lane::store(t + k, lane::select(met, at, zero));
      lane::store(face + k, entering ? ends.in_face : ends.out_face);
    });
  }
};
simd::Native<CrossConvex> const cross_convex;

} // namespace

void World::crossings_of(PrimitiveId id, std::size_t count, VectorArrays const& origins,
                         VectorArrays const& directions, Start const* starts, bool entering,
                         Scratch& scratch, double* t, std::uint32_t* face) const {
  Placed const& placed = impl_->primitives[id];
  EndsKernel const* const kernel = placed.shape().ends_kernel();
  bool const alike = starts == nullptr || std::all_of(starts, starts + count, [&](Start const& s) {
                       return s.face == starts->face && s.to_inside == starts->to_inside;
                     });
  if (kernel != nullptr && kernel->ends_visible() && alike) {
    constexpr std::size_t some = 64;
    alignas(64) double faces[some];
    for (std::size_t first = 0; first < count; first += some) {
      std::size_t const part = std::min(some, count - first);
      cross_convex(placed, *kernel, part, origins.from(first), directions.from(first), starts,
                   entering, t + first, faces);
      for (std::size_t k = 0; k < part; ++k) face[first + k] = static_cast<std::uint32_t>(faces[k]);
    }
    return;
  }
  for (std::size_t k = 0; k < count; ++k) {
    Ray const ray{origins.get(k), directions.get(k), Vec3(0), Vec3(0), Vec3(0)};
    scratch.crossings.clear();
    placed.shape().crossings(placed.to_object(ray), starts != nullptr ? starts + k : nullptr,
                             scratch.crossings);
    t[k] = 0;
    face[k] = 0;
    for (Crossing const& c : scratch.crossings)
      if (c.entering == entering && c.visible && c.t > 0 && (t[k] == 0 || c.t < t[k])) {
        t[k] = c.t;
        face[k] = c.face;
      }
  }
}

} // namespace abbe::geometry
