// SPDX-License-Identifier: MIT
#include "geometry/shapes/superellipsoid_size.hpp"

#include "simd/native.hpp"

#include <cmath>

namespace abbe::geometry {

namespace {

using Power = SuperellipsoidSize::Power;

constexpr double ulp = 0x1p-52, infinite = std::numeric_limits<double>::infinity();
/// Bound of the rounding of a few operations, in all that is not said apart.
constexpr double few = 16 * ulp;

/// (a^k + b^k)^(1/k), a, b >= 0.
template <class L>
L joined(L const& a, L const& b, double k) {
  L const zero(0.0), most = lane::max(a, b), least = lane::min(a, b);
  L const ratio = lane::select(most == zero, zero, least / most);
  L const u = lane::exp(L(k) * lane::log(ratio));
  return most * lane::exp(lane::log(L(1.0) + u) * L(1 / k));
}

template <class L>
struct Bounds {
  L low, high;
};
/// @param off share that both may be off by
template <class L>
Bounds<L> outward(L const& low, L const& high, L const& off) {
  L const least(std::numeric_limits<double>::min());
  auto const good = low <= high;
  return {lane::select(good, low - (lane::abs(low) * off + least), L(-infinite)),
          lane::select(good, high + (lane::abs(high) * off + least), L(infinite))};
}
template <class L>
Bounds<L> outward(L const& low, L const& high) {
  return outward(low, high, L(few));
}

/// (part / whole)^(k - 1), 0 <= part <= whole.
template <class L>
Bounds<L> share(Bounds<L> const& part, Bounds<L> const& whole, double k) {
  L const zero(0.0), one(1.0);
  if (k == 1) return {one, one};
  L const low = lane::select(zero < whole.high, lane::max(part.low, zero) / whole.high, zero);
  L const high = lane::select(zero < whole.low, lane::min(one, part.high / whole.low), one);
  // A ratio is off by a few units; what its logarithm is off by counts k - 1 times.
  auto const power = [&](L const& ratio) { return L(k - 1) * lane::log(ratio); };
  L const x = power(low), y = power(high);
  L const of_x = lane::exp(x), of_y = lane::exp(y);
  auto const off = [&](L const& exponent) {
    return L(few + 8 * ulp * std::fabs(k)) + L(4 * ulp) * lane::min(lane::abs(exponent), L(800.0));
  };
  Bounds<L> const out =
      outward(lane::min(of_x, of_y), lane::max(of_x, of_y), lane::max(off(x), off(y)));
  return {lane::max(out.low, zero), out.high};
}

/// A place, of either sign, on a piece of a line.
template <class L>
struct Places {
  Bounds<L> signed_, size;

  Places(double origin, double direction, L const& from, L const& to) {
    if (direction == 0) {
      signed_ = {L(origin), L(origin)};
    } else {
      L const a = L(direction) * from, b = L(direction) * to;
      L const off = L(4 * ulp) * (L(std::fabs(origin)) + lane::max(lane::abs(a), lane::abs(b)))
                    + L(std::numeric_limits<double>::min());
      signed_ = {L(origin) + lane::min(a, b) - off, L(origin) + lane::max(a, b) + off};
    }
    L const zero(0.0);
    size = {lane::max(zero, lane::max(signed_.low, -signed_.high)),
            lane::max(lane::abs(signed_.low), lane::abs(signed_.high))};
  }
};

template <class L>
struct Sizes {
  Bounds<L> ring, all;

  Sizes(Places<L> const (&v)[3], Power const& p, Power const& q) {
    L const low = joined(v[0].size.low, v[1].size.low, p.k),
            high = joined(v[0].size.high, v[1].size.high, p.k);
    ring = outward(low, high, L(p.joined));
    all = outward(joined(low, v[2].size.low, q.k), joined(high, v[2].size.high, q.k),
                  L(p.joined + q.joined));
  }
};

/// How the size changes along the line by one of the places.
template <class L>
Bounds<L> change(Places<L> const& place, Bounds<L> const& share, double speed) {
  L const zero(0.0);
  if (speed == 0) return {zero, zero};
  L const a = share.low * L(speed), b = share.high * L(speed);
  Bounds<L> const up = outward(lane::min(a, b), lane::max(a, b));
  L const most = lane::max(lane::abs(up.low), lane::abs(up.high));
  auto const above = zero < place.signed_.low, below = place.signed_.high < zero;
  return {lane::select(above, up.low, lane::select(below, -up.high, -most)),
          lane::select(above, up.high, lane::select(below, -up.low, most))};
}

struct Line {
  Vec3 origin, direction;
  Power p, q;
};

template <class L>
struct Told {
  Bounds<L> value, slope, middle;

  Told(Line const& line, L const& from, L const& to) {
    Vec3 const &o = line.origin, &d = line.direction;
    Places<L> const v[3] = {{o.x, d.x, from, to}, {o.y, d.y, from, to}, {o.z, d.z, from, to}};
    Sizes<L> const over(v, line.p, line.q);
    value = over.all;
    L const zero(0.0);
    // 1 is the level: of pieces that are clear of it, nothing else is asked.
    constexpr double near = 0x1p-20;
    auto const clear = lane::either(L(1 + near) < value.low, value.high < L(1 - near));
    if (lane::none(lane::negate(clear))) {
      slope = {L(-infinite), L(infinite)};
      middle = value;
      return;
    }
    auto const of = [&](Bounds<L> const& b) { return Bounds<L>{lane::max(zero, b.low), b.high}; };
    Bounds<L> const ring = of(over.ring), all = of(over.all);
    double const p = line.p.k, q = line.q.k;
    Bounds<L> const to_ring = share(ring, all, q), to_z = share(v[2].size, all, q);
    auto const through = [&](Places<L> const& place) {
      Bounds<L> const own = share(place.size, ring, p);
      // Zero times a bound that is not reached is zero.
      auto const times = [&](L const& a, L const& b) {
        return lane::select(lane::either(a == zero, b == zero), zero, a * b);
      };
      Bounds<L> const out = outward(times(own.low, to_ring.low), times(own.high, to_ring.high));
      return Bounds<L>{lane::max(zero, out.low), out.high};
    };
    Bounds<L> const x = change(v[0], through(v[0]), d.x), y = change(v[1], through(v[1]), d.y),
                    z = change(v[2], to_z, d.z);
    // Outward by what the sum is rounded, not by what is left of it.
    auto const rounded = [&](L const& a, L const& b, L const& c) {
      return L(few) * (lane::abs(a) + lane::abs(b) + lane::abs(c));
    };
    L const low = (x.low + y.low) + z.low - rounded(x.low, y.low, z.low);
    L const high = (x.high + y.high) + z.high + rounded(x.high, y.high, z.high);
    auto const known = lane::both(low <= high, lane::negate(clear));
    slope = {lane::select(known, low, L(-infinite)), lane::select(known, high, L(infinite))};
    L const t = L(0.5) * from + L(0.5) * to;
    Places<L> const m[3] = {{o.x, d.x, t, t}, {o.y, d.y, t, t}, {o.z, d.z, t, t}};
    Bounds<L> const here = Sizes<L>(m, line.p, line.q).all;
    middle = {lane::select(clear, value.low, here.low), lane::select(clear, value.high, here.high)};
  }
};

struct LookAtPieces {
  template <class L>
  static void run(Line const& line, LinePieces& pieces) {
    lane::in_lanes<L>(static_cast<std::size_t>(pieces.count),
                      [&]<class V>(std::size_t at) { lanes<V>(line, pieces, at); });
  }
  template <class L>
  static void lanes(Line const& line, LinePieces& pieces, std::size_t at) {
    Told<L> const told(line, lane::load<L>(pieces.low + at), lane::load<L>(pieces.high + at));
    lane::store(pieces.value_low + at, told.value.low);
    lane::store(pieces.value_high + at, told.value.high);
    lane::store(pieces.slope_low + at, told.slope.low);
    lane::store(pieces.slope_high + at, told.slope.high);
    lane::store(pieces.middle_low + at, told.middle.low);
    lane::store(pieces.middle_high + at, told.middle.high);
  }
};

simd::Native<LookAtPieces> const look_at_pieces;

} // namespace

// u = (a/b)^k <= 1 is off by u |log u| < 0.4 units and its own rounding; log (1 + u) <= 0.7, k
// times divided, and the quotient 1 / k are off by some units each.
Power::Power(double of) : k(of), joined(few + 4 * ulp / of) {}

SuperellipsoidSize::SuperellipsoidSize(double p, double q) : p_(p), q_(q) {}

double SuperellipsoidSize::value(Vec3 const& point) const {
  Vec3 const v = glm::abs(point);
  return joined(joined(v.x, v.y, p_.k), v.z, q_.k);
}

Vec3 SuperellipsoidSize::gradient(Vec3 const& point) const {
  Vec3 const v = glm::abs(point);
  if (v == Vec3(0)) return v;
  if (v.x == 0 && v.y == 0) return {0, 0, std::copysign(1.0, point.z)};
  auto const share = grown_size<double>({v.x, v.y, v.z}, p_.k, q_.k).share;
  return {std::copysign(share.x, point.x), std::copysign(share.y, point.y),
          std::copysign(share.z, point.z)};
}

ScalarField::Along SuperellipsoidSize::along(Vec3 const& origin, Vec3 const& direction,
                                             Interval const& part) const {
  Told<double> const told({origin, direction, p_, q_}, part.low, part.high);
  return {{told.value.low, told.value.high}, {told.slope.low, told.slope.high}};
}

void SuperellipsoidSize::along_each(Vec3 const& origin, Vec3 const& direction,
                                    LinePieces& pieces) const {
  look_at_pieces({origin, direction, p_, q_}, pieces);
}

} // namespace abbe::geometry
