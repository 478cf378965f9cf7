// SPDX-License-Identifier: MIT
#include "transport/lamps/parallel.hpp"

#include "simd/native.hpp"

namespace abbe::transport {
namespace {

struct AimAlong {
  template <class L>
  static void run(Vec3 const& position, Vec3 const& direction, Vectors const& points,
                  std::size_t count, Aim& out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      lane::store(out.distance.value + k,
                  lane::dot(load<Lanes>(points, k) - all<Lanes>(position), all<Lanes>(direction)));
      store(out.direction, k, all<Lanes>(-direction));
    });
  }
};
simd::Native<AimAlong> const aim_along;

} // namespace

void ParallelLamp::find_ways(Vectors const& points, std::size_t count, Aim& out) const {
  aim_along(position_, direction_, points, count, out);
}

} // namespace abbe::transport
