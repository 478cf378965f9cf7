// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"
#include "simd/lane.hpp"

#include <limits>

/// The vocabulary of the kernels: a line in object space with what is known of its rounding, and
/// what a convex shape cuts out of it.
namespace abbe::geometry {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// p(t) = origin + t direction, with bounds, per component, of the rounding errors that origin and
/// direction got from the transform, and of how far the origin may be from where it is meant to be.
template <class L>
struct Line {
  lane::Vec<L> origin, direction;
  lane::Vec<L> origin_rounding, direction_rounding, slack;
};
inline Line<double> line_of(Ray const& ray) {
  auto const v = [](Vec3 const& p) { return lane::Vec<double>{p.x, p.y, p.z}; };
  return {v(ray.origin), v(ray.direction), v(ray.origin_rounding), v(ray.direction_rounding),
          v(ray.origin_error)};
}

/// Where a line meets a surface: t, the bound of its rounding error for the line as given, and how
/// far t moves at most when the origin moves within its slack.
template <class L>
struct Root {
  L t{}, error{}, slack{};
};

/// The part of a line that is inside a convex shape: from `in` to `out` (either may be infinite),
/// and through which faces. Empty unless in.t < out.t.
template <class L>
struct Slice {
  Root<L> in, out;
  L in_face{}, out_face{};
};

template <class L, class M>
Root<L> select(M const& mask, Root<L> const& a, Root<L> const& b) {
  return {lane::select(mask, a.t, b.t), lane::select(mask, a.error, b.error),
          lane::select(mask, a.slack, b.slack)};
}

/// What two convex shapes have in common on a line. The error is that of the face that decides.
template <class L>
Slice<L> common(Slice<L> const& a, Slice<L> const& b) {
  auto const later_in = a.in.t < b.in.t;
  auto const sooner_out = b.out.t < a.out.t;
  return {select(later_in, b.in, a.in), select(sooner_out, b.out, a.out),
          lane::select(later_in, b.in_face, a.in_face),
          lane::select(sooner_out, b.out_face, a.out_face)};
}

/// Bound of how far a root of f moves when f is uncertain by `e`, where f'(root) = `slope` and
/// f'' = `bend`: first order away from tangency, a square root at it.
/// From |sqrt(D + 2 b e) - sqrt(D)| <= 2 b e / max(sqrt(D), sqrt(2 b e)), D = slope^2.
template <class L>
L root_motion(L const& e, L const& slope, L const& bend) {
  if (lane::none(L(0.0) < e)) return L(0.0);
  L const steep = lane::max(lane::abs(slope), lane::sqrt(L(2.0) * lane::abs(bend) * e));
  return lane::select(L(0.0) < e, L(2.0) * e / steep, L(0.0));
}

/// The line with its origin moved along itself to near the closest approach to the middle of the
/// shape, where nothing cancels (Haines et al. 2019): point = origin + t direction, with its
/// rounding.
template <class L>
struct Approach {
  lane::Vec<L> point, rounding;
  L t{};
};
template <class L>
Approach<L> approach(Line<L> const& line, L const& t) {
  lane::Vec<L> const step = t * line.direction;
  lane::Vec<L> const point = line.origin + step;
  lane::Vec<L> const rounding = line.origin_rounding + lane::abs(t) * line.direction_rounding
                                + L(unit_roundoff) * (lane::abs(step) + lane::abs(point));
  return {point, rounding, t};
}

} // namespace abbe::geometry
