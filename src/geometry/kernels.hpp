// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"

/// What a line shares with the simple convex shapes, in their canonical space, for any lane type.
/// Error bounds are first order: (bound of the rounding of the implicit function f near the root)
/// over its slope, times two. The constants 8 and 4 count the roundings of the expressions, rounded
/// up.
namespace abbe::geometry::kernels {

/// Both roots of a s^2 + 2 b s + c = 0 in order, without cancellation; not ordered when a < 0.
template <class L>
struct Roots {
  L low{}, high{}, root_of_discriminant{};
};
template <class L>
Roots<L> roots(L const& a, L const& b, L const& c, L const& discriminant) {
  L const zero(0.0);
  L const root = lane::sqrt(lane::max(discriminant, zero));
  L const q = -(b + lane::select(b < zero, -root, root));
  L const first = q / a;
  L const second = lane::select(q == zero, first, c / q);
  return {lane::min(first, second), lane::max(first, second), root};
}

/// Half-space normal . p <= 0. @param face number of the plane
template <class L>
Slice<L> half_space(Line<L> const& line, lane::Vec<L> const& normal, L const& face) {
  L const zero(0.0), far(infinity);
  lane::Vec<L> const size = lane::abs(normal);
  L const height = lane::dot(normal, line.origin);
  L const speed = lane::dot(normal, line.direction);
  L const t = -height / speed;
  L const rounding = lane::dot(size, line.origin_rounding)
                     + lane::abs(t) * lane::dot(size, line.direction_rounding)
                     + L(gamma_bound(4))
                           * (lane::dot(size, lane::abs(line.origin))
                              + lane::abs(t) * lane::dot(size, lane::abs(line.direction)));
  Root<L> const root{t, rounding / lane::abs(speed) + L(gamma_bound(2)) * lane::abs(t),
                     lane::dot(size, line.slack) / lane::abs(speed)};
  auto const inside = height <= zero;
  auto const along = speed == zero; // no root: all of the line or nothing
  L const in = lane::select(along, lane::select(inside, -far, far), -far);
  L const out = lane::select(along, lane::select(inside, far, -far), far);
  return {select(speed < zero, root, Root<L>{in, zero, zero}),
          select(zero < speed, root, Root<L>{out, zero, zero}), face, face};
}

/// Slab -1 <= x <= 1 along one axis. Faces: `face` at -1, `face` + 1 at +1.
template <class L>
Slice<L> slab(L const& o, L const& d, L const& o_rounding, L const& d_rounding, L const& slack,
              L const& face) {
  L const zero(0.0), one(1.0), far(infinity);
  L const speed = lane::abs(d);
  auto const make = [&](L const& side) {
    L const t = (side - o) / d;
    L const rounding =
        o_rounding + lane::abs(t) * d_rounding + L(gamma_bound(4)) * (one + lane::abs(o));
    return Root<L>{t, rounding / speed + L(gamma_bound(2)) * lane::abs(t), slack / speed};
  };
  auto const rising = zero < d;
  Root<L> const in = make(lane::select(rising, -one, one));
  Root<L> const out = make(lane::select(rising, one, -one));
  auto const along = d == zero;
  auto const inside = lane::abs(o) <= one;
  Root<L> const none_in{lane::select(inside, -far, far), zero, zero};
  Root<L> const none_out{lane::select(inside, far, -far), zero, zero};
  return {select(along, none_in, in), select(along, none_out, out),
          face + lane::select(rising, zero, one), face + lane::select(rising, one, zero)};
}

/// What a slab knows along its axis, before any error is computed.
template <class L>
struct SlabEnd {
  L t, o, d, o_rounding, d_rounding, slack, face;
};
template <class L, class M>
SlabEnd<L> select(M const& mask, SlabEnd<L> const& a, SlabEnd<L> const& b) {
  return {lane::select(mask, a.t, b.t),
          lane::select(mask, a.o, b.o),
          lane::select(mask, a.d, b.d),
          lane::select(mask, a.o_rounding, b.o_rounding),
          lane::select(mask, a.d_rounding, b.d_rounding),
          lane::select(mask, a.slack, b.slack),
          lane::select(mask, a.face, b.face)};
}
/// The error of an end of a slab; none where the line is along the slab.
template <class L>
Root<L> slab_root(SlabEnd<L> const& end) {
  L const zero(0.0), one(1.0), speed = lane::abs(end.d);
  L const rounding = end.o_rounding + lane::abs(end.t) * end.d_rounding
                     + L(gamma_bound(4)) * (one + lane::abs(end.o));
  auto const along = end.d == zero;
  return {end.t, lane::select(along, zero, rounding / speed + L(gamma_bound(2)) * lane::abs(end.t)),
          lane::select(along, zero, end.slack / speed)};
}

/// Cube [-1, 1]^3: three slabs, with the errors of those faces alone that decide. Faces: 0 -x,
/// 1 +x, 2 -y, 3 +y, 4 -z, 5 +z.
template <class L>
Slice<L> cube(Line<L> const& l) {
  L const zero(0.0), one(1.0), far(infinity);
  auto const ends = [&](L const& o, L const& d, L const& o_rounding, L const& d_rounding,
                        L const& slack, L const& face, SlabEnd<L>& in, SlabEnd<L>& out) {
    auto const rising = zero < d;
    auto const along = d == zero;
    L const side = lane::select(rising, one, -one);
    L const none = lane::select(lane::abs(o) <= one, far, -far);
    L const in_t = lane::select(along, -none, (-side - o) / d);
    L const out_t = lane::select(along, none, (side - o) / d);
    in = {in_t, o, d, o_rounding, d_rounding, slack, face + lane::select(rising, zero, one)};
    out = {out_t, o, d, o_rounding, d_rounding, slack, face + lane::select(rising, one, zero)};
  };
  SlabEnd<L> in, out, next_in, next_out;
  auto const narrow = [&] {
    in = select(in.t < next_in.t, next_in, in);
    out = select(next_out.t < out.t, next_out, out);
  };
  ends(l.origin.x, l.direction.x, l.origin_rounding.x, l.direction_rounding.x, l.slack.x, zero, in,
       out);
  ends(l.origin.y, l.direction.y, l.origin_rounding.y, l.direction_rounding.y, l.slack.y, L(2.0),
       next_in, next_out);
  narrow();
  ends(l.origin.z, l.direction.z, l.origin_rounding.z, l.direction_rounding.z, l.slack.z, L(4.0),
       next_in, next_out);
  narrow();
  return {slab_root(in), slab_root(out), in.face, out.face};
}

/// Ball of radius 1 about the origin, or (`Endless`) about the y axis. The discriminant is taken at
/// the closest approach, as (1 - r)(1 + r).
template <bool Endless, class L>
Slice<L> ball(Line<L> const& given, L const& face) {
  L const zero(0.0), one(1.0), far(infinity);
  Line<L> line = given;
  if constexpr (Endless) {
    line.origin.y = line.direction.y = zero;
    line.origin_rounding.y = line.direction_rounding.y = line.slack.y = zero;
  }
  L const a = lane::dot(line.direction, line.direction);
  auto const along = a == zero;
  L const shift = lane::select(along, zero, -lane::dot(line.origin, line.direction) / a);
  Approach<L> const near = approach(line, shift);
  L const b = lane::dot(near.point, line.direction);
  L const radius = lane::sqrt(lane::dot(near.point, near.point));
  L const c = (radius - one) * (radius + one);
  L const discriminant = b * b - a * c;
  auto const inside = c <= zero;
  Root<L> const none_in{lane::select(lane::both(along, inside), -far, far), zero, zero};
  Root<L> const none_out{lane::select(lane::both(along, inside), far, -far), zero, zero};
  auto const hit = lane::both(lane::negate(along), zero <= discriminant);
  if (lane::none(hit)) return {none_in, none_out, face, face};
  Roots<L> const s = roots(a, b, c, discriminant);
  L const half = s.root_of_discriminant;
  L const e =
      lane::sum(near.rounding) + half / a * lane::sum(line.direction_rounding) + L(gamma_bound(8));
  L const rounding = root_motion(e, half, a);
  L const slack = root_motion(lane::sum(line.slack), half, a);
  auto const make = [&](L const& step) {
    L const t = near.t + step;
    return Root<L>{t, rounding + L(gamma_bound(2)) * (lane::abs(t) + lane::abs(step)), slack};
  };
  return {select(hit, make(s.low), none_in), select(hit, make(s.high), none_out), face, face};
}

template <class L>
Slice<L> sphere(Line<L> const& line) {
  return ball<false>(line, L(0.0));
}

/// x^2 + z^2 <= 1, -1 <= y <= 1. Faces: 0 wall, 1 bottom, 2 top.
template <class L>
Slice<L> cylinder(Line<L> const& l) {
  Slice<L> const lids = slab(l.origin.y, l.direction.y, l.origin_rounding.y, l.direction_rounding.y,
                             l.slack.y, L(1.0));
  return common(lids, ball<true>(l, L(0.0)));
}

/// sqrt(x^2 + z^2) <= middle + rate y, -1 <= y <= 1: the part of a cone on its own side of the
/// apex. The larger of the two radii is 1. Faces: 0 wall, 1 bottom, 2 top.
template <class L>
Slice<L> cone(Line<L> const& line, L const& middle, L const& rate) {
  L const zero(0.0), far(infinity);
  L const length2 = lane::dot(line.direction, line.direction);
  Approach<L> const near = approach(line, -lane::dot(line.origin, line.direction) / length2);
  L const px = near.point.x, pz = near.point.z, vx = line.direction.x, vz = line.direction.z;
  L const p = lane::sqrt(px * px + pz * pz), v = lane::sqrt(vx * vx + vz * vz);
  L const r = middle + rate * near.point.y, w = rate * line.direction.y; // radius r + s w
  L const a = (v - w) * (v + w), b = (px * vx + pz * vz) - r * w, c = (p - r) * (p + r);
  L const discriminant = lane::difference_of_products(b, b, a, c);
  Roots<L> const s = roots(a, b, c, discriminant);
  L const half = s.root_of_discriminant;
  auto const make = [&](L const& step) {
    L const t = near.t + step, size = lane::abs(step), here = lane::abs(r + step * w);
    L const reach = p + lane::abs(r) + size * (v + lane::abs(w));
    lane::Vec<L> const moved = near.rounding + size * line.direction_rounding;
    auto const across = [&](lane::Vec<L> const& m) {
      return here * (m.x + m.z + lane::abs(rate) * m.y);
    };
    L const e = across(moved) + L(gamma_bound(8)) * reach * reach;
    return Root<L>{t, root_motion(e, half, a) + L(gamma_bound(2)) * (lane::abs(t) + size),
                   root_motion(across(line.slack), half, a)};
  };
  Root<L> const low = make(s.low), high = make(s.high);
  Root<L> const line_start{-far, zero, zero}, line_end{far, zero, zero};
  // a > 0: both roots on one side of the apex, and a slice between them when it is the right side.
  // a < 0: one root on each side, the slice goes on from the right one for ever. a == 0: one root.
  auto const crosswise = zero < a;
  auto const between =
      lane::both(zero <= discriminant, zero <= r + w * (L(0.5) * (s.low + s.high)));
  Root<L> const single = make(-c / (b + b));
  auto const flat = a == zero;
  Root<L> const ahead = select(flat, single, high), behind = select(flat, single, low);
  auto const widening = zero < w;
  auto const straight = w == zero; // with a <= 0: along the axis of a cylinder
  L const all = lane::select(c <= zero, -far, far);
  Root<L> in = select(widening, ahead, select(straight, Root<L>{all, zero, zero}, line_start));
  Root<L> out = select(widening, line_end, select(straight, Root<L>{-all, zero, zero}, behind));
  in = select(crosswise, select(between, low, line_end), in);
  out = select(crosswise, select(between, high, line_start), out);
  Slice<L> const lids = slab(line.origin.y, line.direction.y, line.origin_rounding.y,
                             line.direction_rounding.y, line.slack.y, L(1.0));
  return common(lids, Slice<L>{in, out, zero, zero});
}

} // namespace abbe::geometry::kernels
