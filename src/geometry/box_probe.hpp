// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"

#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// Lines against boxes. The boxes are floats, the computation is in doubles: a float is a double
/// without loss, and both boxes of a node fill one register. What is found depends on boxes only in
/// that none that a line meets is left out.
namespace abbe::geometry {

/// A number for each of the two boxes of a node.
using BoxPair = double __attribute__((vector_size(16)));

inline BoxPair load_planes(float const* from) {
#if defined(__SSE2__)
  double both;
  std::memcpy(&both, from, sizeof both);
  return _mm_cvtps_pd(_mm_castpd_ps(_mm_set_sd(both)));
#else
  return BoxPair{from[0], from[1]};
#endif
}
inline BoxPair same(double x) {
  return BoxPair{x, x};
}
template <class L>
L least(L const& a, L const& b) {
  return a < b ? a : b; // b where one is NaN: a single instruction
}
template <class L>
L most(L const& a, L const& b) {
  return a > b ? a : b;
}
/// Bits of the boxes where entry <= end.
inline unsigned met_boxes(BoxPair const& entry, BoxPair const& end) {
  auto const met = entry <= end;
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(met)));
#else
  return static_cast<unsigned>((met[0] & 1) | (met[1] & 2));
#endif
}

/// Each bound of t has three roundings (pbrt 6.8.2): the difference, the inverse, the product. They
/// are relative: the widening does not change which is the last, or the first.
template <class L>
void widen_cut(L& in, L& out) {
  constexpr double wide = 1 + 2 * gamma_bound(3), tight = 1 - 2 * gamma_bound(3);
  in = least(in * wide, in * tight);
  out = most(out * wide, out * tight);
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
    widen_cut(in, out);
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
      : near(falling ? 6 + 2 * axis : 2 * axis), far(6 + 4 * axis - near) {}
  BoxPair near_planes(BvhNode const& node) const {
    return load_planes(&node.planes[0][0][0] + near);
  }
  BoxPair far_planes(BvhNode const& node) const { return load_planes(&node.planes[0][0][0] + far); }
  bool falling() const { return near >= 6; }
};

/// One line against the boxes of a hierarchy: as BoxProbe; the roundings of the origin are in it.
class NodeProbe {
public:
  using Single = BoxProbe;

  NodeProbe(Ray const& ray, BvhSpace const& space)
      : NodeProbe(ray, space, [](int, double at, double way) { return BoxOrigin(at, way); }) {}
  /// The boxes wider by `reach` on each side.
  NodeProbe(Ray const& ray, BvhSpace const& space, Vec3 const& reach)
      : NodeProbe(ray, space, [&](int axis, double at, double way) {
          double const wide = reach[axis] * space.per_unit * (1 + 4 * unit_roundoff);
          return BoxOrigin(at, way, std::fabs(at) * (4 * unit_roundoff) + wide);
        }) {}

  /// Where the line is in each box of a node within [from, to]. @return bits of the boxes it meets
  unsigned enter(BvhNode const& node, double from, double to, double (&entry)[2]) const {
    BoxPair in = same(-BoxRange::infinite), out = same(BoxRange::infinite);
    for (Axis const& axis : axes_) {
      in = most((axis.sides.near_planes(node) - axis.near) * axis.inverse, in);
      out = least((axis.sides.far_planes(node) - axis.far) * axis.inverse, out);
    }
    widen_cut(in, out);
    in = most(in, same(from));
    out = least(out, same(to));
    std::memcpy(entry, &in, sizeof in);
    return met_boxes(in, out);
  }

private:
  struct Axis {
    BoxPair near, far, inverse; ///< BoxOrigin; 1 / direction, NaN where it is not tested
    BoxSides sides;
  };

  template <class Origin>
  NodeProbe(Ray const& ray, BvhSpace const& space, Origin const& origin)
      : axes_{axis(ray, space, origin, 0), axis(ray, space, origin, 1),
              axis(ray, space, origin, 2)} {
    double smallest = BoxRange::infinite, largest = 0, far = 0;
    for (Axis const& axis : axes_) {
      double const size = std::fabs(axis.inverse[0]);
      smallest = least(size, smallest);
      largest = most(size, largest);
      far += std::fabs(axis.near[0]);
    }
    bool const usable = smallest >= BoxRange::smallest_inverse
                        && largest <= BoxRange::largest_inverse && far <= BoxRange::farthest;
    if (!usable) leave_untested(ray, far <= BoxRange::farthest);
  }
  template <class Origin>
  static Axis axis(Ray const& ray, BvhSpace const& space, Origin const& origin, int i) {
    double const inverse = space.unit / ray.direction[i];
    BoxOrigin const at = origin(i, (ray.origin[i] - space.centre[i]) * space.per_unit, inverse);
    return {same(at.near), same(at.far), same(inverse),
            BoxSides(static_cast<std::size_t>(i), !(inverse > 0))};
  }
  void leave_untested(Ray const& ray, bool near);

  Axis axes_[3];
};

} // namespace abbe::geometry
