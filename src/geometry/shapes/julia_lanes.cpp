// SPDX-License-Identifier: MIT
#include "geometry/shapes/julia_lanes.hpp"

#include "simd/native.hpp"

#include <limits>

namespace abbe::geometry {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Bound of the rounding of a few operations.
constexpr double share = 16 * 0x1p-53;

/// A number a + v, as four lanes.
template <class L>
struct Number {
  L a, x, y, z;
};
template <class L>
Number<L> number(Vec4 const& v) {
  return {L(v.x), L(v.y), L(v.z), L(v.w)};
}
template <class L>
L inner(Number<L> const& p, Number<L> const& q) {
  return (p.a * q.a + p.x * q.x) + (p.y * q.y + p.z * q.z);
}
template <class L>
L inner_of_vectors(Number<L> const& p, Number<L> const& q) {
  return p.x * q.x + (p.y * q.y + p.z * q.z);
}

struct Complex {
  double re, im;
};

/// Bounds, outward by `share` of them.
template <class L>
struct Bounds {
  L low, high;
};
template <class L>
Bounds<L> outward(L const& low, L const& high) {
  L const least(std::numeric_limits<double>::min());
  auto const good = low <= high;
  return {lane::select(good, low - (lane::abs(low) * L(share) + least), L(-infinite)),
          lane::select(good, high + (lane::abs(high) * L(share) + least), L(infinite))};
}

/// Sizes of the numbers of a disc or ball, of their squares less the limit, and their rates.
template <class L>
struct Sizes {
  L low, high;
};
template <class L>
Sizes<L> sizes(L const& size, L const& radius) {
  return {lane::max(L(0.0), size * L(1 - share) - radius), size * L(1 + share) + radius};
}

/// A piece of the line: the number in its middle, and the radii of the balls about it that hold the
/// piece and, `e`, the middle's rounding.
template <class L>
struct Piece {
  Number<L> middle;
  L radius, e;
};
template <class L>
Piece<L> piece(JuliaLine const& line, LinePieces const& pieces, std::size_t at) {
  L const low = lane::load<L>(pieces.low + at), high = lane::load<L>(pieces.high + at);
  L const t = L(0.5) * low + L(0.5) * high, half = (high - low) * L(0.5);
  Number<L> const o = number<L>(line.origin), d = number<L>(line.direction);
  L const e = L(line.grain) * (L(line.origin_size) + lane::abs(t) * L(line.direction_size));
  L const fast = lane::sqrt(inner(d, d));
  return {{o.a + t * d.a, o.x + t * d.x, o.y + t * d.y, o.z + t * d.z},
          half * fast * L(1 + share) + e,
          e};
}

template <class L>
void keep(LinePieces& pieces, std::size_t at, Bounds<L> const& value, Bounds<L> const& slope,
          Bounds<L> const& middle) {
  lane::store(pieces.value_low + at, value.low);
  lane::store(pieces.value_high + at, value.high);
  lane::store(pieces.slope_low + at, slope.low);
  lane::store(pieces.slope_high + at, slope.high);
  lane::store(pieces.middle_low + at, middle.low);
  lane::store(pieces.middle_high + at, middle.high);
}

/// What is said of pieces that are certainly outside.
constexpr double certainly = 1e-300;

template <bool cube>
struct OfQuaternions {
  template <class L>
  static void run(JuliaLine const& line, LinePieces& pieces) {
    lane::in_lanes<L>(static_cast<std::size_t>(pieces.count),
                      [&]<class V>(std::size_t at) { lanes<V>(line, pieces, at); });
  }

  template <class L>
  static void lanes(JuliaLine const& line, LinePieces& pieces, std::size_t at) {
    Piece<L> const start = piece<L>(line, pieces, at);
    Number<L> h = start.middle, d = number<L>(line.direction);
    L r = start.radius, e = start.e, dr(0.0);
    L const limit(line.limit), zero(0.0), two(2.0);
    auto outside = limit < zero;
    L size(0.0);
    for (int round = 1;; ++round) {
      size = lane::sqrt(inner(h, h));
      if (round == line.rounds) break;
      L const low = sizes(size, r).low;
      outside = lane::either(outside, limit * L(1 + share) < low * low);
      if (lane::none(lane::negate(outside))) break;
      L const fast = lane::sqrt(inner(d, d)), high = size + r;
      L const vector = inner_of_vectors(h, d);
      if constexpr (cube) {
        L const aa = h.a * h.a, vv = inner_of_vectors(h, h), three(3.0);
        L const along = three * aa - vv, turn = L(6.0) * h.a * d.a - two * vector;
        L const square = size * size;
        dr = three * (fast * (r * (two * size + r)) + dr * (high * high))
             + L(3 * share) * (fast * square);
        d = {three * (aa - vv) * d.a - L(6.0) * h.a * vector, turn * h.x + along * d.x,
             turn * h.y + along * d.y, turn * h.z + along * d.z};
        h = {h.a * (aa - three * vv), along * h.x, along * h.y, along * h.z};
        auto const radius = [&](L const& of) {
          return of * (three * square + of * (three * size + of)) + L(share) * (square * size);
        };
        r = radius(r);
        e = radius(e);
      } else {
        L const twice = two * h.a, turn = two * d.a;
        dr = two * (fast * r + dr * high) + L(2 * share) * (fast * size);
        d = {two * (h.a * d.a - vector), turn * h.x + twice * d.x, turn * h.y + twice * d.y,
             turn * h.z + twice * d.z};
        h = {h.a * h.a - inner_of_vectors(h, h), twice * h.x, twice * h.y, twice * h.z};
        L const rounding = L(share) * (size * size);
        r = (two * size + r) * r + rounding;
        e = (two * size + e) * e + rounding;
      }
      L const grain(share * line.limit);
      h = {h.a + L(line.added.x), h.x + L(line.added.y), h.y + L(line.added.z),
           h.z + L(line.added.w)};
      r = r + grain;
      e = e + grain;
    }
    Sizes<L> const all = sizes(size, r), here = sizes(size, e);
    Bounds<L> value = outward(all.low * all.low - limit, all.high * all.high - limit);
    Bounds<L> middle = outward(here.low * here.low - limit, here.high * here.high - limit);
    L const fast = lane::sqrt(inner(d, d)), rate = inner(h, d);
    L const off = size * dr + fast * r + r * dr + L(share) * (size * fast);
    Bounds<L> slope = outward(two * (rate - off), two * (rate + off));
    auto const set = [&](Bounds<L>& b, double low) {
      b = {lane::select(outside, L(low), b.low), lane::select(outside, L(infinite), b.high)};
    };
    set(value, certainly);
    set(middle, certainly);
    set(slope, -infinite);
    keep(pieces, at, value, slope, middle);
  }
};

/// The two complex numbers of a hypercomplex one: x - w + i (y + z) and x + w + i (y - z). The
/// square of its size is half of the sum of the squares of both.
template <class L>
struct Half {
  L re, im, slope_re, slope_im, added_re, added_im;
  L r, e;    ///< radii of the discs of the piece, and of the middle's rounding
  L slope_r; ///< of the slope's
  L fast;    ///< size of the slope, which products multiply

  Half(L const& a, L const& b, L const& da, L const& db, Complex const& added, Piece<L> const& of)
      : re(a),
        im(b),
        slope_re(da),
        slope_im(db),
        added_re(added.re),
        added_im(added.im),
        r(L(2.0) * of.radius),
        e(L(2.0) * of.e),
        slope_r(0.0),
        fast(lane::sqrt(da * da + db * db) * L(1 + share)) {}
  L size() const { return lane::sqrt(re * re + im * im); }
  void square(L const& size, double limit) {
    L const two(2.0);
    L const rounding = L(share) * (size * size) + L(share * 2 * limit);
    slope_r = two * (slope_r * (size + r) + r * fast) + L(2 * share) * (size * fast);
    fast = two * size * fast * L(1 + share);
    L const next = two * (re * slope_re - im * slope_im);
    slope_im = two * (re * slope_im + im * slope_re);
    slope_re = next;
    L const real = re * re - im * im;
    im = two * (re * im) + added_im;
    re = real + added_re;
    r = (two * size + r) * r + rounding;
    e = (two * size + e) * e + rounding;
  }
};

/// What both halves of a number tell of the square of its size, less the limit.
template <class L>
struct Told {
  Bounds<L> value, middle, slope;

  Told(Half<L> const* z, L const* size, double limit) {
    L const zero(0.0), half(0.5), level(limit);
    Bounds<L> square{zero, zero}, own{zero, zero}, rate{zero, zero};
    for (int i = 0; i < 2; ++i) {
      Half<L> const& k = z[i];
      Sizes<L> const all = sizes(size[i], k.r), here = sizes(size[i], k.e);
      square = {square.low + half * (all.low * all.low),
                square.high + half * (all.high * all.high)};
      own = {own.low + half * (here.low * here.low), own.high + half * (here.high * here.high)};
      L const along = k.re * k.slope_re + k.im * k.slope_im;
      L const off = (size[i] + k.r) * k.slope_r + k.fast * k.r + L(share) * (size[i] * k.fast);
      rate = {rate.low + (along - off), rate.high + (along + off)};
    }
    // Outward by what the sums themselves are rounded, not by what is left of them.
    auto const less = [&](Bounds<L> const& b) {
      return outward(b.low * L(1 - share) - level, b.high * L(1 + share) - level);
    };
    value = less(square);
    middle = less(own);
    slope = outward(rate.low, rate.high);
  }
};

/// @tparam returns numbers beyond the bailout may come back: then the largest of all counts, else
///         the last
template <bool returns>
struct OfPairs {
  template <class L>
  static void run(JuliaLine const& line, LinePieces& pieces) {
    lane::in_lanes<L>(static_cast<std::size_t>(pieces.count),
                      [&]<class V>(std::size_t at) { lanes<V>(line, pieces, at); });
  }

  template <class L>
  static void lanes(JuliaLine const& line, LinePieces& pieces, std::size_t at) {
    Piece<L> const start = piece<L>(line, pieces, at);
    Number<L> const &h = start.middle, d = number<L>(line.direction);
    L const zero(0.0);
    Vec4 const& c = line.added;
    Half<L> z[2] = {{h.a - h.z, h.x + h.y, d.a - d.z, d.x + d.y, {c.x - c.w, c.y + c.z}, start},
                    {h.a + h.z, h.x - h.y, d.a + d.z, d.x - d.y, {c.x + c.w, c.y - c.z}, start}};
    Bounds<L> value{L(-infinite), L(-infinite)}, middle = value, slope{L(infinite), L(-infinite)};
    auto outside = zero < zero;
    for (int round = 1;; ++round) {
      L const size[2] = {z[0].size(), z[1].size()};
      bool const last = round == line.rounds;
      if (returns || last) {
        Told<L> const now(z, size, line.limit);
        // The largest of all: the slope is that of any that may be it.
        auto const alone = value.high < now.value.low, never = now.value.high < value.low;
        auto const still = lane::negate(outside);
        auto const fresh = lane::both(still, lane::negate(never));
        auto const take = [&](L& into, L const& from) { into = lane::select(fresh, from, into); };
        take(slope.low, lane::select(alone, now.slope.low, lane::min(slope.low, now.slope.low)));
        take(slope.high,
             lane::select(alone, now.slope.high, lane::max(slope.high, now.slope.high)));
        auto const raise = [&](Bounds<L>& into, Bounds<L> const& by) {
          into = {lane::select(still, lane::max(into.low, by.low), into.low),
                  lane::select(still, lane::max(into.high, by.high), into.high)};
        };
        raise(value, now.value);
        raise(middle, now.middle);
        outside = lane::either(outside, zero < now.value.low);
      } else {
        L const low[2] = {sizes(size[0], z[0].r).low, sizes(size[1], z[1].r).low};
        outside = lane::either(outside,
                               L(line.limit * 2 * (1 + share)) < low[0] * low[0] + low[1] * low[1]);
      }
      if (last || lane::none(lane::negate(outside))) break;
      for (int i = 0; i < 2; ++i) z[i].square(size[i], line.limit);
    }
    auto const set = [&](Bounds<L>& b, double low) {
      b = {lane::select(outside, L(low), b.low), lane::select(outside, L(infinite), b.high)};
    };
    set(value, certainly);
    set(middle, certainly);
    set(slope, -infinite);
    keep(pieces, at, value, slope, middle);
  }
};

simd::Native<OfQuaternions<false>> const squares;
simd::Native<OfQuaternions<true>> const cubes;
simd::Native<OfPairs<false>> const pairs;
simd::Native<OfPairs<true>> const returning_pairs;

} // namespace

void julia_along_each(JuliaLine::Kind kind, JuliaLine const& line, LinePieces& pieces) {
  switch (kind) {
  case JuliaLine::Kind::Squares:
    return squares(line, pieces);
  case JuliaLine::Kind::Cubes:
    return cubes(line, pieces);
  case JuliaLine::Kind::Pairs:
    return pairs(line, pieces);
  case JuliaLine::Kind::ReturningPairs:
    return returning_pairs(line, pieces);
  }
}

} // namespace abbe::geometry
