// SPDX-License-Identifier: MIT
#include "transport/lamps/point.hpp"

#include "simd/native.hpp"

namespace abbe::transport {
namespace {

struct AimAtPoint {
  template <class L>
  static void run(Vec3 const& position, Vectors const& points, std::size_t count, Aim& out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      lane::Vec<Lanes> const way = all<Lanes>(position) - load<Lanes>(points, k);
      Lanes const distance = lane::sqrt(lane::dot(way, way));
      lane::store(out.distance.value + k, distance);
      store(out.direction, k,
            lane::Vec<Lanes>{way.x / distance, way.y / distance, way.z / distance});
    });
  }
};
simd::Native<AimAtPoint> const aim_at_point;

} // namespace

void PointLamp::find_ways(Vectors const& points, std::size_t count, Aim& out) const {
  aim_at_point(position_, points, count, out);
}

} // namespace abbe::transport
