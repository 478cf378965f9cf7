// SPDX-License-Identifier: MIT
#include "geometry/bvh_walk.hpp"

#include "geometry/fan_probe.hpp"
#include "simd/native.hpp"

namespace abbe::geometry {

namespace {

template <class Probe>
struct Next {
  template <class L>
  static bool run(BvhWalk<Probe>& walk, double to, typename BvhWalk<Probe>::Leaf& leaf) {
    return walk.template next_in<L>(to, leaf);
  }
};

} // namespace

template <class Probe>
bool BvhWalk<Probe>::next(double to, Leaf& leaf) {
  static constexpr simd::Native<Next<Probe>> native;
  return native(*this, to, leaf);
}
template bool BvhWalk<NodeProbe>::next(double, Leaf&);
template bool BvhWalk<FanNodeProbe>::next(double, Leaf&);

} // namespace abbe::geometry
