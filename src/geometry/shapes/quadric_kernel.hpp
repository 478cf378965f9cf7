// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/kernels.hpp"
#include "geometry/shapes/gap_kernel.hpp"

namespace abbe::geometry::kernels {

/// Both roots of a x^2 + ... = 0 for a general quadric; `between`: the inside is between the roots.
template <class L>
struct QuadricRoots {
  Root<L> low, high;
  L leading{}; ///< > 0: inside between the roots; < 0: outside between them; 0: one root, `low`
  L slope{};   ///< sign of the derivative at the only root when leading == 0
  L value{};   ///< at some point of the line
  L exists{};  ///< 1 or 0
};
/// f = A x^2 + B y^2 + C z^2 + D xy + E xz + F yz + G x + H y + I z + J.
template <class L>
QuadricRoots<L> quadric(Line<L> const& line, L const (&k)[10]) {
  L const zero(0.0), half(0.5), two(2.0);
  lane::Vec<L> const& d = line.direction;
  L const length2 = lane::dot(d, d);
  Approach<L> const near = approach(line, -lane::dot(line.origin, d) / length2);
  lane::Vec<L> const& p = near.point;
  auto const square = [&](lane::Vec<L> const& v) {
    return k[0] * (v.x * v.x) + k[1] * (v.y * v.y) + k[2] * (v.z * v.z) + k[3] * (v.x * v.y)
           + k[4] * (v.x * v.z) + k[5] * (v.y * v.z);
  };
  auto const square_size = [&](lane::Vec<L> const& v) {
    return lane::abs(k[0] * (v.x * v.x)) + lane::abs(k[1] * (v.y * v.y))
           + lane::abs(k[2] * (v.z * v.z)) + lane::abs(k[3] * (v.x * v.y))
           + lane::abs(k[4] * (v.x * v.z)) + lane::abs(k[5] * (v.y * v.z));
  };
  auto const slope = [&](lane::Vec<L> const& v) {
    return lane::Vec<L>{two * (k[0] * v.x) + k[3] * v.y + k[4] * v.z + k[6],
                        two * (k[1] * v.y) + k[3] * v.x + k[5] * v.z + k[7],
                        two * (k[2] * v.z) + k[4] * v.x + k[5] * v.y + k[8]};
  };
  L const a = square(d);
  L const b = half * lane::dot(slope(p), d);
  L const c = square(p) + (k[6] * p.x + k[7] * p.y + k[8] * p.z) + k[9];
  L const discriminant = lane::difference_of_products(b, b, a, c);
  Roots<L> const s = roots(a, b, c, discriminant);
  auto const make = [&](L const& step) {
    lane::Vec<L> const q = p + step * d;
    L const t = near.t + step, size = lane::abs(step);
    lane::Vec<L> const g = lane::abs(slope(q));
    lane::Vec<L> const moved = near.rounding + size * line.direction_rounding;
    L const rounding = L(gamma_bound(12))
                       * (square_size(p) + size * size * square_size(d) + lane::abs(k[6] * p.x)
                          + lane::abs(k[7] * p.y) + lane::abs(k[8] * p.z) + lane::abs(k[9])
                          + size * lane::dot(lane::abs(slope(p)), lane::abs(d)));
    L const e = half * (lane::dot(g, moved) + rounding);
    return Root<L>{
        t, root_motion(e, s.root_of_discriminant, a) + L(gamma_bound(2)) * (lane::abs(t) + size),
        root_motion(half * lane::dot(g, line.slack), s.root_of_discriminant, a)};
  };
  auto const linear = a == zero;
  auto const any = lane::both(zero <= discriminant, lane::negate(lane::both(linear, b == zero)));
  return {make(lane::select(linear, -c / (b + b), s.low)),
          make(s.high),
          a,
          b,
          c,
          lane::select(any, L(1.0), zero)};
}
/// The same where the inside is convex: A, B, C >= 0 and D, E, F 0.
template <class L>
Slice<L> convex_quadric(Line<L> const& line, L const (&k)[10]) {
  L const zero(0.0), far(infinity);
  QuadricRoots<L> const roots = quadric(line, k);
  auto const exists = zero < roots.exists;
  auto const two = lane::both(exists, zero < roots.leading);
  auto const one = lane::both(exists, lane::negate(zero < roots.leading));
  // All of the line or nothing.
  auto const all =
      lane::both(lane::negate(exists), lane::both(roots.leading == zero, roots.value <= zero));
  L const in = lane::select(lane::either(all, one), -far, far);
  L const out = lane::select(lane::either(all, one), far, -far);
  auto const enters = lane::both(one, roots.slope < zero),
             leaves = lane::both(one, zero < roots.slope);
  return {select(lane::either(two, enters), roots.low, Root<L>{in, zero, zero}),
          select(two, roots.high, select(leaves, roots.low, Root<L>{out, zero, zero})), zero, zero};
}

/// Any quadric's roots.
template <class L>
Gap<L> gap_quadric(Line<L> const& line, L const (&k)[10]) {
  L const zero(0.0), far(infinity), sure(1.0);
  QuadricRoots<L> const roots = quadric(line, k);
  auto const exists = zero < roots.exists, single = roots.leading == zero;
  auto const two = lane::both(exists, lane::negate(single));
  auto const one = lane::both(exists, single);
  auto const enters = lane::both(one, roots.slope < zero),
             leaves = lane::both(one, lane::negate(roots.slope < zero));
  // Without roots it is the one or the other all along.
  auto const all = lane::both(lane::negate(exists), lane::both(single, roots.value <= zero));
  Root<L> const none_in{lane::select(all, -far, far), zero, zero},
      none_out{lane::select(all, far, -far), zero, zero};
  Root<L> const begin{-far, zero, zero}, end{far, zero, zero};
  Root<L> const in = select(two, roots.low,
                            select(enters, roots.low, select(leaves, begin, none_in))),
                out = select(two, roots.high,
                             select(leaves, roots.low, select(enters, end, none_out)));
  return {{in.t, in.error, out.t, out.error, zero, zero},
          lane::select(roots.leading < zero, sure, zero),
          lane::select(lane::both(two, lane::negate(roots.low.t < roots.high.t)), sure, zero)};
}

} // namespace abbe::geometry::kernels
