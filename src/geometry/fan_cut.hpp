// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/convex_cut.hpp"
#include "geometry/plane_filter.hpp"
#include "geometry/shapes/convex.hpp"

/// ConvexCut for the rays of a fan, one a lane: the half-spaces one after the other, each for all
/// lanes. As there, what the filter finds is where about and whose; where that is not clear of all
/// else, by error intervals, nothing is said.
namespace abbe::geometry {

/// Lines that departed from the same surface, one a lane, in world space.
template <class L>
struct LaneRays {
  lane::Vec<L> origin, direction, origin_error;
};

/// The last of the ways in, or the first of the ways out, so far.
/// @tparam Sign 1: the first counts, and -1: the last, with all t negated
template <class L, int Sign>
class LaneEnd {
public:
  using Mask = decltype(L() < L());
  /// In those lanes, something is crossed at t +- error. @param place whose number it has
  void take(Mask const& mask, L const& t, L const& error, L const& place) {
    L const own = lane::select(mask, Sign > 0 ? t : -t, L(infinity)), begin = own - error;
    auto const nearer = own < t_;
    t_ = lane::min(t_, own);
    error_ = lane::select(nearer, error, error_);
    place_ = lane::select(nearer, place, place_);
    second_begin_ = lane::min(second_begin_, lane::max(first_begin_, begin));
    first_begin_ = lane::min(first_begin_, begin);
  }
  L t() const { return Sign > 0 ? t_ : -t_; }
  L const& error() const { return error_; }
  L const& place() const { return place_; }
  Mask found() const { return t_ < L(infinity); }
  /// Others are within their errors of it: there are two that begin before its end.
  Mask crowded() const { return second_begin_ <= t_ + error_; }
  /// Where the first error interval of all begins. @pre Sign > 0
  L const& first_begin() const { return first_begin_; }

private:
  L t_{infinity}, error_{0.0}, place_{-1.0};
  L first_begin_{infinity}, second_begin_{infinity};
};

/// The first end of the solid after the start.
template <class L>
struct CutEnd {
  using Mask = decltype(L() < L());
  Mask unclear;     ///< ask for this ray alone
  Mask found;       ///< not unclear, and there is one
  L place;          ///< of the half-spaces; beyond their number: of the other operands
  L t, error, face; ///< of the other operands alone
  L after;          ///< where the next one begins, or before
  Mask enters;      ///< the solid
};

/// @param listed the half-spaces that count for these rays; null: all
template <class L>
CutEnd<L> first_end_of(ConvexCut const& cut, std::vector<Placed> const& primitives,
                       LaneRays<L> const& rays, Departure const* from,
                       CutDeparture const& departure, PlaneList const* listed) {
  L const zero(0.0), one(1.0);
  HalfSpaces const& planes = cut.planes();
  auto nothing = one < zero, unclear = nothing;
  LaneEnd<L, -1> in;
  LaneEnd<L, 1> out;
  L const at_rest = planes.at_rest_of(
      rays.origin, from != nullptr ? rays.origin_error : lane::Vec<L>{zero, zero, zero});
  L const per_t = planes.per_t_of(rays.direction);
  L const slow = L(HalfSpaces::clear_factor) * per_t;
  std::size_t const count = listed != nullptr ? listed->count : planes.count();
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t const k = listed != nullptr ? listed->place[i] : i;
    auto const [normal, level] = planes.plane(k);
    lane::Vec<L> const n{L(normal.x), L(normal.y), L(normal.z)};
    L const height = lane::dot(n, rays.origin) - L(level);
    L const speed = lane::dot(n, rays.direction);
    L const steepness = lane::abs(speed);
    if (k == departure.plane) {
      // Inside of it from the start on, or outside for good.
      L const onwards = departure.to_inside ? -speed : speed;
      unclear = lane::either(unclear, lane::negate(slow < onwards));
      if (!departure.to_inside) nothing = lane::either(nothing, slow < speed);
      continue;
    }
    auto const leaving = zero < speed, above = zero < height;
    nothing = lane::either(nothing, lane::both(at_rest < height, slow < speed));
    unclear = lane::either(unclear, lane::either(lane::abs(height) <= at_rest, steepness <= slow));
    L const slowness = one / speed;
    L const t = -(height * slowness);
    L const error = (at_rest + lane::abs(t) * per_t) * lane::abs(slowness);
    L const place(static_cast<double>(k));
    out.take(leaving, t, error, place);
    auto const entering = lane::both(lane::negate(leaving), above);
    if (!lane::none(entering)) in.take(entering, t, error, place);
  }
  std::size_t place = planes.count();
  CutEnd<L> end{};
  L in_face = zero, out_face = zero;
  for (ConvexCut::Operand const& operand : cut.others()) {
    Placed const& placed = primitives[operand.primitive];
    Start start;
    bool const starts = find_start(from, operand.primitive, start);
    Ends<L> ends;
    placed.shape().ends_kernel()->ends(placed.line<L>(rays.origin, rays.direction),
                                       starts ? &start : nullptr, ends);
    L const blurred = starts || from == nullptr ? zero : one;
    auto const past = [&](L const& t, L const& error) { return t <= blurred * error; };
    auto const missed = lane::negate(ends.in_t < ends.out_t);
    nothing = lane::either(nothing, lane::either(missed, past(ends.out_t, ends.out_error)));
    auto const met = lane::negate(nothing);
    L const number(static_cast<double>(place));
    auto const enters = lane::both(met, lane::negate(past(ends.in_t, ends.in_error)));
    in.take(enters, ends.in_t, L(group_margin) * ends.in_error, number);
    out.take(met, ends.out_t, L(group_margin) * ends.out_error, number);
    in_face = lane::select(in.place() == number, ends.in_face, in_face);
    out_face = lane::select(out.place() == number, ends.out_face, out_face);
    ++place;
  }
  L const apart = in.error() + out.error();
  nothing = lane::either(nothing, apart < in.t() - out.t());
  end.enters = in.found();
  auto const in_order = apart < out.t() - in.t();
  auto const crowds_entry = lane::either(in.crowded(), out.first_begin() <= in.t() + in.error());
  auto const crowds =
      lane::either(lane::both(end.enters, crowds_entry),
                   lane::both(lane::negate(end.enters), lane::both(out.found(), out.crowded())));
  end.unclear = lane::both(lane::negate(nothing),
                           lane::either(unclear, lane::either(lane::negate(in_order), crowds)));
  end.found = lane::both(lane::negate(lane::either(nothing, end.unclear)),
                         lane::either(end.enters, out.found()));
  auto const choose = [&](L const& a, L const& b) { return lane::select(end.enters, a, b); };
  end.place = choose(in.place(), out.place());
  end.t = choose(in.t(), out.t());
  end.error = choose(in.error(), out.error());
  end.face = choose(in_face, out_face);
  end.after = choose(out.first_begin(), L(infinity));
  return end;
}

} // namespace abbe::geometry
