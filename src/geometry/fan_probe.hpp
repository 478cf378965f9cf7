// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "geometry/fan.hpp"
#include "geometry/lane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::geometry {

/// The boxes that any ray of a fan may meet: BoxProbe in interval arithmetic. An axis along which
/// the rays do not all go the same way is not tested.
class FanProbe {
public:
  /// @param rays filled up
  explicit FanProbe(FanLines const& rays)
      : axes_{axis(rays, rays.origin.x, rays.direction.x),
              axis(rays, rays.origin.y, rays.direction.y),
              axis(rays, rays.origin.z, rays.direction.z)} {}

  /// As BoxProbe::enter, of the first of the rays.
  template <class V>
  bool enter(V const& low, V const& high, double from, double to, double& entry) const {
    constexpr double wide = 1 + 2 * gamma_bound(3), tight = 1 - 2 * gamma_bound(3);
    for (int i = 0; i < 3; ++i) {
      Axis const& axis = axes_[i];
      if (!axis.tested) continue;
      double const near = axis.falling ? axis.near_origin - high[i] : low[i] - axis.near_origin;
      double const far = axis.falling ? axis.far_origin - low[i] : high[i] - axis.far_origin;
      double const begin = near < 0 ? near * axis.most * wide : near * axis.least * tight;
      double const end = far < 0 ? far * axis.least * tight : far * axis.most * wide;
      if (begin > from) from = begin;
      if (end < to) to = end;
    }
    entry = from;
    return from <= to;
  }

private:
  struct Axis {
    double near_origin, far_origin; ///< of the rays: from which boxes seem nearest, farthest
    double least, most;             ///< of 1 / |direction|
    bool tested, falling;
  };
  static Axis axis(FanLines const& rays, double const* origin, double const* direction) {
    using lane::Double4, lane::load;
    Double4 lows = load<Double4>(origin), highs = lows;
    Double4 slow = load<Double4>(direction), fast = slow;
    for (std::size_t k = 4; k < rays.count; k += 4) {
      Double4 const o = load<Double4>(origin + k), d = load<Double4>(direction + k);
      lows = lane::min(lows, o);
      highs = lane::max(highs, o);
      slow = lane::min(slow, d);
      fast = lane::max(fast, d);
    }
    double low = lane::least(lows), high = -lane::least(-highs);
    double slowest = lane::least(slow), fastest = -lane::least(-fast);
    bool const falling = fastest < 0;
    if (falling) {
      std::swap(low, high);
      slowest = -slowest;
      fastest = -fastest;
      std::swap(slowest, fastest);
    }
    // As seen along the way: near counts from the origin that is farthest on.
    return {high,
            low,
            1.0 / fastest,
            1.0 / slowest,
            slowest > 0 && 1.0 / slowest < std::numeric_limits<double>::infinity(),
            falling};
  }
  Axis axes_[3];
};

} // namespace abbe::geometry
