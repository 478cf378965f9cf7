// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/box_probe.hpp"
#include "geometry/fan.hpp"
#include "geometry/lane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::geometry {

/// The least and the largest of the rays' origins and directions, by axis.
struct FanExtents {
  struct Range {
    double least, largest;
  };
  Range origin[3], direction[3];
  /// By the largest errors of the rays' origins.
  FanExtents widened(FanLines const& rays) const {
    FanExtents out = *this;
    double const* const errors[3] = {rays.origin_error.x, rays.origin_error.y, rays.origin_error.z};
    for (int axis = 0; axis < 3; ++axis) {
      double const by = *std::max_element(errors[axis], errors[axis] + rays.count);
      out.origin[axis].least -= by;
      out.origin[axis].largest += by;
    }
    return out;
  }
};
/// @param rays filled up
template <class L>
FanExtents extents_of(FanLines const& rays) {
  auto const range = [&](double const* values) {
    L low = lane::load<L>(values), high = low;
    for (std::size_t k = 4; k < rays.count; k += 4) {
      L const v = lane::load<L>(values + k);
      low = lane::min(low, v);
      high = lane::max(high, v);
    }
    return FanExtents::Range{lane::least(low), -lane::least(-high)};
  };
  return {{range(rays.origin.x), range(rays.origin.y), range(rays.origin.z)},
          {range(rays.direction.x), range(rays.direction.y), range(rays.direction.z)}};
}

/// The boxes that any ray of a fan may meet: BoxProbe in interval arithmetic. An axis along which
/// the rays do not all go the same way is not tested.
class FanProbe {
public:
  explicit FanProbe(FanExtents const& of)
      : axes_{axis(of.origin[0], of.direction[0]), axis(of.origin[1], of.direction[1]),
              axis(of.origin[2], of.direction[2])} {}

  /// As BoxProbe::enter, of the first of the rays.
  bool enter(Vec3 const& low, Vec3 const& high, double from, double to, double& entry) const {
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
  static Axis axis(FanExtents::Range const& origin, FanExtents::Range const& direction) {
    double low = origin.least, high = origin.largest;
    double slowest = direction.least, fastest = direction.largest;
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

/// FanProbe for the boxes of a hierarchy, as NodeProbe is BoxProbe.
class FanNodeProbe {
public:
  using Single = FanProbe;

  FanNodeProbe(FanExtents const& of, BvhSpace const& space)
      : axes_{axis(of.origin[0], of.direction[0], space, 0),
              axis(of.origin[1], of.direction[1], space, 1),
              axis(of.origin[2], of.direction[2], space, 2)} {}

  /// As BoxProbe::enter, of the first of the rays.
  unsigned enter(BvhNode const& node, double from, double to, double (&entry)[2]) const {
    BoxPair in = same(from), out = same(to);
    for (Axis const& axis : axes_) {
      BoxPair const first = axis.sides.near_planes(node) - axis.near;
      BoxPair const last = axis.sides.far_planes(node) - axis.far;
      // By the fastest ray where it lies ahead, by the slowest where it lies behind.
      in = most(least(first * axis.slowest, first * axis.fastest), in);
      out = least(most(last * axis.slowest, last * axis.fastest), out);
    }
    std::memcpy(entry, &in, sizeof in);
    return met_boxes(in, out);
  }

private:
  struct Axis {
    BoxPair near, far;        ///< of the rays: from which boxes seem nearest, farthest
    BoxPair fastest, slowest; ///< 1 / direction, with room for roundings; NaN: not tested
    BoxSides sides;
  };

  static Axis axis(FanExtents::Range const& origin, FanExtents::Range const& direction,
                   BvhSpace const& space, int i) {
    constexpr double wide = 1 + 2 * gamma_bound(4), tight = 1 - 2 * gamma_bound(4);
    bool const falling = direction.largest < 0;
    // As seen along the way: near counts from the origin that is farthest on.
    double const front = falling ? origin.least : origin.largest;
    double const back = falling ? origin.largest : origin.least;
    double fastest = space.unit / (falling ? direction.least : direction.largest) * tight;
    double slowest = space.unit / (falling ? direction.largest : direction.least) * wide;
    BoxOrigin const ahead((front - space.centre[i]) * space.per_unit, fastest);
    BoxOrigin const behind((back - space.centre[i]) * space.per_unit, fastest);
    bool const tested = (falling || direction.least > 0)
                        && std::fabs(fastest) >= BoxRange::smallest_inverse
                        && std::fabs(slowest) <= BoxRange::largest_inverse
                        && std::fabs(ahead.near) + std::fabs(behind.far) <= BoxRange::farthest;
    if (!tested) fastest = slowest = std::numeric_limits<double>::quiet_NaN();
    return {same(ahead.near), same(behind.far), same(fastest), same(slowest),
            BoxSides(static_cast<std::size_t>(i), falling)};
  }
  Axis axes_[3];
};

} // namespace abbe::geometry
