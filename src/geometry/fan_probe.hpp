// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/box_probe.hpp"
#include "geometry/fan.hpp"
#include "simd/lane.hpp"

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
  /// How far the rays go apart: in direction, and where they start as a share of `size`.
  double spread(double size) const {
    double apart = 0;
    for (int axis = 0; axis < 3; ++axis)
      apart += direction[axis].largest - direction[axis].least
               + (origin[axis].largest - origin[axis].least) / size;
    return apart;
  }
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

/// Along an axis where some rays rise and some fall, or do not move: those that rise most reach a
/// box above them all first, those that fall most one below. Where none of them ever leaves a box
/// again is not asked.
/// @param rise per_rise() of the directions; @param fall their per_fall()
template <class L>
L spread_entry(L const& above, L const& rise, L const& below, L const& fall, L const& from) {
  return simd::max(simd::max(from, below * fall),
                   above * rise); // NaN, 0 times infinity, is not taken
}

/// 1 / the direction that rises most, and that falls most: infinite where none does.
inline double per_rise(FanExtents::Range const& direction) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return direction.largest > 0 ? 1.0 / direction.largest : infinite;
}
inline double per_fall(FanExtents::Range const& direction) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return direction.least < 0 ? 1.0 / direction.least : -infinite;
}

/// The boxes that any ray of a fan may meet: BoxProbe in interval arithmetic.
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
      if (axis.spread) {
        double const begin = spread_entry(low[i] - axis.near_origin, axis.most,
                                          high[i] - axis.far_origin, axis.least, 0.0);
        if (begin * tight > from) from = begin * tight;
        continue;
      }
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
    double least, most;             ///< of 1 / |direction|; spread: 1 / the least, the largest
    bool spread, falling;
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
    bool const spread = !(slowest > 0 && 1.0 / slowest < std::numeric_limits<double>::infinity());
    // As seen along the way: near counts from the origin that is farthest on.
    if (!spread) return {high, low, 1.0 / fastest, 1.0 / slowest, false, falling};
    return {origin.largest, origin.least, per_fall(direction), per_rise(direction), true, false};
  }
  Axis axes_[3];
};

/// The least and the largest t of a fan whose numbers are floats, rounded away.
inline float fan_bound(double t, double side) {
  return static_cast<float>(t + side * (std::fabs(t) * 0x1p-22 + 0x1p-140));
}

/// FanProbe for the boxes of a hierarchy, which are floats: the computation is in doubles.
class FanNodeProbe {
public:
  using Single = FanProbe;
  template <class L>
  using LanesOf = L;

  FanNodeProbe(FanExtents const& of, BvhSpace const& space) {
    for (int i = 0; i < 3; ++i) {
      if (Axis const along = axis(of.origin[i], of.direction[i], space, i); along.usable)
        axes_[count_++] = along;
      else
        spread_[spread_count_++] = spread(of.origin[i], of.direction[i], space, i);
    }
  }
  float from(double t) const { return fan_bound(t, -1); }
  float until(double t) const { return fan_bound(t, 1); }

  template <class L>
  class Lanes {
  public:
    Lanes(FanNodeProbe const& of, float from) : of_(of), from_(from) {}
    /// As NodeProbe, of the first of the rays.
    unsigned enter(BvhNode const& node, float to, float (&entry)[BvhNode::width]) const {
      constexpr std::size_t step = simd::width<L>;
      unsigned met = 0;
      float const* const planes = &node.planes[0][0][0];
      double begin[BvhNode::width], end[BvhNode::width];
      for (std::size_t first = 0; first < BvhNode::width; first += step) {
        L in(from_), out(to);
        for (int i = 0; i < of_.count_; ++i) {
          Axis const& axis = of_.axes_[i];
          L const near = doubles(planes + axis.sides.near + first) - L(axis.near);
          L const far = doubles(planes + axis.sides.far + first) - L(axis.far);
          // By the fastest ray where it lies ahead, by the slowest where it lies behind.
          in = simd::max(in, simd::min(near * L(axis.slowest), near * L(axis.fastest)));
          out = simd::min(out, simd::max(far * L(axis.slowest), far * L(axis.fastest)));
        }
        for (int i = 0; i < of_.spread_count_; ++i) {
          Spread const& axis = of_.spread_[i];
          in = spread_entry(
              doubles(planes + axis.sides.near + first) - L(axis.highest), L(axis.per_rise),
              doubles(planes + axis.sides.far + first) - L(axis.lowest), L(axis.per_fall), in);
        }
        simd::store(begin + first, in);
        simd::store(end + first, out);
      }
      for (std::size_t k = 0; k < BvhNode::width; ++k) {
        if (!(begin[k] <= end[k])) continue;
        met |= 1U << k;
        entry[k] = fan_bound(begin[k], -1);
      }
      return met;
    }

  private:
    static L doubles(float const* from) {
      alignas(64) double out[simd::width<L>];
      for (std::size_t k = 0; k < simd::width<L>; ++k) out[k] = static_cast<double>(from[k]);
      return simd::load<L>(out);
    }
    FanNodeProbe const& of_;
    double from_;
  };

private:
  struct Axis {
    double near, far;        ///< of the rays: from which boxes seem nearest, farthest
    double fastest, slowest; ///< 1 / direction, with room for roundings
    BoxSides sides{0, false};
    bool usable = false;
  };
  /// As spread_entry() asks for it.
  struct Spread {
    double highest, lowest; ///< of the origins
    double per_rise, per_fall;
    BoxSides sides{0, false};
  };

  static constexpr double wide = 1 + 2 * gamma_bound(4), tight = 1 - 2 * gamma_bound(4);

  static Axis axis(FanExtents::Range const& origin, FanExtents::Range const& direction,
                   BvhSpace const& space, int i) {
    bool const falling = direction.largest < 0;
    // As seen along the way: near counts from the origin that is farthest on.
    double const front = falling ? origin.least : origin.largest;
    double const back = falling ? origin.largest : origin.least;
    double const fastest = space.unit / (falling ? direction.least : direction.largest) * tight;
    double const slowest = space.unit / (falling ? direction.largest : direction.least) * wide;
    BoxOrigin const ahead((front - space.centre[i]) * space.per_unit, fastest);
    BoxOrigin const behind((back - space.centre[i]) * space.per_unit, fastest);
    bool const usable = (falling || direction.least > 0)
                        && std::fabs(fastest) >= BoxRange::smallest_inverse
                        && std::fabs(slowest) <= BoxRange::largest_inverse
                        && std::fabs(ahead.near) + std::fabs(behind.far) <= BoxRange::farthest;
    return {
        ahead.near, behind.far, fastest, slowest, BoxSides(static_cast<std::size_t>(i), falling),
        usable};
  }
  static Spread spread(FanExtents::Range const& origin, FanExtents::Range const& direction,
                       BvhSpace const& space, int i) {
    BoxOrigin const high((origin.largest - space.centre[i]) * space.per_unit, 1.0);
    BoxOrigin const low((origin.least - space.centre[i]) * space.per_unit, -1.0);
    bool const near = std::fabs(high.near) + std::fabs(low.near) <= BoxRange::farthest;
    // Of no motion, infinite: what is not beside the rays is never reached.
    auto const inverse = [&](double per_direction) {
      double const scaled = space.unit * per_direction * tight, size = std::fabs(scaled);
      bool const usable =
          near
          && (size == BoxRange::infinite
              || (size >= BoxRange::smallest_inverse && size <= BoxRange::largest_inverse));
      return usable ? scaled : std::numeric_limits<double>::quiet_NaN();
    };
    return {high.near, low.near, inverse(per_rise(direction)), inverse(per_fall(direction)),
            BoxSides(static_cast<std::size_t>(i), false)};
  }

  Axis axes_[3];
  Spread spread_[3];
  int count_ = 0, spread_count_ = 0;
};

} // namespace abbe::geometry
