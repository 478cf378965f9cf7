// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "simd/float_lanes.hpp"

#include <cmath>
#include <limits>

/// Lines against boxes. What is found depends on boxes only in that none that a line meets is left
/// out.
namespace abbe::geometry {

template <class L>
L least(L const& a, L const& b) {
  return a < b ? a : b; // b where one is NaN: a single instruction
}
template <class L>
L most(L const& a, L const& b) {
  return a > b ? a : b;
}

/// A line against single boxes of doubles.
struct BoxProbe {
  Vec3 origin, inverse;
  explicit BoxProbe(Ray const& ray) : origin(ray.origin), inverse(1.0 / ray.direction) {}

  /// Where the line is in the box within [from, to]: the entry, or false.
  bool enter(Vec3 const& low, Vec3 const& high, double from, double to, double& entry) const {
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    for (int i = 0; i < 3; ++i) {
      bool const rising = inverse[i] > 0;
      // NaN, a line in the face's plane, is not taken.
      in = most(((rising ? low[i] : high[i]) - origin[i]) * inverse[i], in);
      out = least(((rising ? high[i] : low[i]) - origin[i]) * inverse[i], out);
    }
    // Each bound of t has three roundings (pbrt 6.8.2): the difference, the inverse, the product.
    // They are relative: the widening does not change which is the last, or the first.
    constexpr double wide = 1 + 2 * gamma_bound(3), tight = 1 - 2 * gamma_bound(3);
    in = least(in * wide, in * tight);
    out = most(out * wide, out * tight);
    entry = most(in, from);
    return entry <= least(out, to);
  }
};

/// Where a ray's origin is along an axis of a space, as the near and the far sides of boxes see it:
/// further on, or further back, by the roundings of the difference and its scaling (which loses
/// nothing but below 2^-1074, where boxes have room) and of this sum.
struct BoxOrigin {
  double near, far;
  /// @param way its sign is that of the direction @param at relative to the centre, in units
  BoxOrigin(double at, double way) : BoxOrigin(at, way, std::fabs(at) * (4 * unit_roundoff)) {}
  /// @param off at least that of the above
  BoxOrigin(double at, double way, double off)
      : near(at + std::copysign(off, way)), far(at - std::copysign(off, way)) {}
};

/// The range in which the quotients of differences by directions neither overflow nor lose digits
/// where it counts; an axis outside of it is not tested (its quotients are NaN).
struct BoxRange {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double smallest_inverse = 0x1p-800, largest_inverse = 0x1p800,
                          farthest = 0x1p1000;
};

/// Which of a node's planes come first along an axis, and which last: places in the floats.
struct BoxSides {
  std::size_t near, far;
  BoxSides(std::size_t axis, bool falling)
      : near(BvhNode::width * (falling ? 3 + axis : axis)),
        far(BvhNode::width * (3 + 2 * axis) - near) {}
};

/// One line against the boxes of a hierarchy, all in floats.
///
/// Floats see the line from where it is nearest to the space's centre: there its place has digits
/// as boxes have, wherever the ray starts. What that and the rounding to floats moves the place, it
/// is moved away from each side it is compared with. Each bound of the way then has three roundings
/// (the difference, the inverse, the product), which a wider exit pays for, of both of a box: where
/// they matter the two are about the same. Ways are counted from that place, in units of the space
/// for a direction whose largest component is in [1, 2): the quotients leave the range of floats
/// only where that says the same.
class NodeProbe {
  /// As BoxOrigin; 1 / direction: infinite across the axis, NaN where it is not tested.
  struct Axis {
    float near, far, inverse;
    BoxSides sides{0, false};
  };

public:
  using Single = BoxProbe;
  template <class L>
  using LanesOf = typename simd::FloatsOf<L>::Type;

  /// @param reach by which boxes are wider on each side
  NodeProbe(Ray const& ray, BvhSpace const& space, Vec3 const& reach = Vec3(0));

  /// A way that is not after that of `t`, and one that is not before it.
  float from(double t) const { return bound(t, -1); }
  float until(double t) const { return bound(t, 1); }

  /// Twice three roundings, and those of the products.
  static constexpr float wide = 1 + 0x1p-20F, tight = 1 - 0x1p-20F;

  /// The line in registers.
  template <class F>
  class Lanes {
  public:
    Lanes(NodeProbe const& of, float from)
        : axes_{axis(of.axes_[0]), axis(of.axes_[1]), axis(of.axes_[2])}, from_(from) {}
    /// Where the line is in each box of a node up to `to`. @return bits of the boxes it meets
    unsigned enter(BvhNode const& node, float to, float (&entry)[BvhNode::width]) const {
      auto const in = [&](Axis const& axis) {
        return (F::load(&node.planes[0][0][0] + axis.sides.near) - axis.near) * axis.inverse;
      };
      auto const out = [&](Axis const& axis) {
        return (F::load(&node.planes[0][0][0] + axis.sides.far) - axis.far) * axis.inverse;
      };
      // What is not a number comes first, and is not taken.
      F const first = most(most(in(axes_[0]), in(axes_[1])), most(in(axes_[2]), from_));
      F const last = least(least(out(axes_[0]), out(axes_[1])), least(out(axes_[2]), F(to)));
      first.store(entry);
      return ~bits(most(last * F(wide), last * F(tight)) < first) & 0xff;
    }

  private:
    struct Axis {
      F near, far, inverse;
      BoxSides sides;
    };
    static Axis axis(NodeProbe::Axis const& of) {
      return {F(of.near), F(of.far), F(of.inverse), of.sides};
    }
    Axis axes_[3];
    F from_;
  };

private:
  float bound(double t, double side) const {
    double const way = t * per_t_ - start_;
    double const off = (std::fabs(t * per_t_) + std::fabs(start_)) * (4 * unit_roundoff)
                       + std::fabs(way) * 0x1p-21 + 0x1p-120;
    return static_cast<float>(way + side * off);
  }

  Axis axes_[3];
  double per_t_, start_; ///< way = t per_t_ - start_
};

} // namespace abbe::geometry
