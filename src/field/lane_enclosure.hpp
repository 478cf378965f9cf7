// SPDX-License-Identifier: MIT
#pragma once

#include "simd/lane.hpp"
#include "simd/math.hpp"

#include <limits>

/// Arithmetic of field::Enclosures in lanes of any type L. Bounds are rounded outward; what cannot
/// be told is everything.
namespace abbe::field {

inline constexpr double all = std::numeric_limits<double>::infinity();
inline constexpr double ulp = 0x1p-52;
/// Units in the last place that the functions of simd/math.hpp may be off by.
inline constexpr int library = 4, library_power = 17;

template <class L>
struct Span {
  L low, high;
};
template <class L>
Span<L> widened(L const& low, L const& high, int roundings = 1) {
  L const share(ulp * roundings), least(std::numeric_limits<double>::min());
  auto const good = low <= high;
  return {lane::select(good, low - (lane::abs(low) * share + least), L(-all)),
          lane::select(good, high + (lane::abs(high) * share + least), L(all))};
}
template <class L>
Span<L> operator-(Span<L> const& a) {
  return {-a.high, -a.low};
}
template <class L>
Span<L> operator+(Span<L> const& a, Span<L> const& b) {
  return widened(a.low + b.low, a.high + b.high);
}
template <class L>
Span<L> operator-(Span<L> const& a, Span<L> const& b) {
  return widened(a.low - b.high, a.high - b.low);
}
/// Zero times a bound that is not reached is left out, or makes everything of the product.
template <class L>
Span<L> operator*(Span<L> const& a, Span<L> const& b) {
  L const p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return widened(lane::min(lane::min(p, q), lane::min(r, s)),
                 lane::max(lane::max(p, q), lane::max(r, s)));
}
template <class L>
Span<L> operator*(double k, Span<L> const& a) {
  L const p = L(k) * a.low, q = L(k) * a.high;
  return k < 0 ? widened(q, p) : widened(p, q);
}
template <class L>
Span<L> hull(Span<L> const& a, Span<L> const& b) {
  return {lane::min(a.low, b.low), lane::max(a.high, b.high)};
}
template <class Mask, class L>
Span<L> select(Mask const& mask, Span<L> const& a, Span<L> const& b) {
  return {lane::select(mask, a.low, b.low), lane::select(mask, a.high, b.high)};
}
template <class L>
Span<L> abs(Span<L> const& a) {
  L const zero(0.0);
  return {lane::max(zero, lane::max(a.low, -a.high)),
          lane::max(lane::abs(a.low), lane::abs(a.high))};
}
template <class L>
L size(Span<L> const& a) {
  return lane::max(lane::abs(a.low), lane::abs(a.high));
}
template <class L>
Span<L> square(Span<L> const& a) {
  Span<L> const s = abs(a), out = widened(s.low * s.low, s.high * s.high);
  return {lane::max(L(0.0), out.low), out.high};
}
template <class L>
Span<L> reciprocal(Span<L> const& a) {
  auto const away = lane::either(L(0.0) < a.low, a.high < L(0.0));
  return select(away, widened(L(1.0) / a.high, L(1.0) / a.low), Span<L>{L(-all), L(all)});
}

/// Enclosures (tape.hpp) of some of the pieces.
template <class L>
struct Known {
  Span<L> v, d;
  L c, e;
};

/// With the mean value form about the middle. @param half of the piece's length
template <class L>
Known<L> centred(Known<L> const& a, L const& half) {
  L const reach = (size(a.d) * half + a.e) * L(1 + 4 * ulp);
  L const off = reach + L(ulp) * lane::abs(a.c);
  return {{lane::max(a.v.low, a.c - off), lane::min(a.v.high, a.c + off)}, a.d, a.c, a.e};
}
/// The value of a function whose derivative on the piece is `rate`: what becomes of `e`.
template <class L>
L error_of(Span<L> const& rate, L const& e, L const& c, int roundings) {
  L const moved = size(rate) * e * L(1 + 4 * ulp);
  return lane::select(e == L(0.0), L(0.0), moved) + L(ulp * roundings) * lane::abs(c);
}

template <class L>
Known<L> sum(Known<L> const& a, Known<L> const& b) {
  L const c = a.c + b.c;
  return {a.v + b.v, a.d + b.d, c, (a.e + b.e) * L(1 + 4 * ulp) + L(ulp) * lane::abs(c)};
}
template <class L>
Known<L> negative(Known<L> const& a) {
  return {-a.v, -a.d, -a.c, a.e};
}
template <class L>
Known<L> sum(Known<L> const& a, double k) {
  L const c = a.c + L(k);
  return {widened(a.v.low + L(k), a.v.high + L(k)), a.d, c, a.e + L(ulp) * (a.e + lane::abs(c))};
}
template <class L>
Known<L> product(Known<L> const& a, double k) {
  L const c = a.c * L(k);
  return {k * a.v, k * a.d, c, lane::abs(L(k)) * a.e * L(1 + 4 * ulp) + L(ulp) * lane::abs(c)};
}
template <class L>
Known<L> product(Known<L> const& a, Known<L> const& b) {
  L const c = a.c * b.c;
  L const e = (lane::abs(a.c) + a.e) * b.e + lane::abs(b.c) * a.e;
  return {a.v * b.v, a.d * b.v + a.v * b.d, c, e * L(1 + 4 * ulp) + L(ulp) * lane::abs(c)};
}
template <class L>
Known<L> squared(Known<L> const& a) {
  L const c = a.c * a.c, e = (L(2.0) * lane::abs(a.c) + a.e) * a.e;
  return {square(a.v), 2.0 * (a.v * a.d), c, e * L(1 + 4 * ulp) + L(ulp) * lane::abs(c)};
}
template <class L>
Known<L> quotient(Known<L> const& a, Known<L> const& b) {
  Span<L> const inverse = reciprocal(b.v), v = a.v * inverse;
  L const c = a.c / b.c;
  L const moved = (a.e + lane::abs(c) * b.e) * size(inverse);
  L const exact = lane::select(a.e + b.e == L(0.0), L(0.0), moved);
  return {v, (a.d - v * b.d) * inverse, c, exact * L(1 + 8 * ulp) + L(2 * ulp) * lane::abs(c)};
}
template <class L>
Known<L> magnitude(Known<L> const& a) {
  L const zero(0.0);
  auto const up = zero <= a.v.low, down = a.v.high <= zero;
  Span<L> const other = -a.d;
  return {abs(a.v), select(up, a.d, select(down, other, hull(a.d, other))), lane::abs(a.c), a.e};
}
template <class L>
Known<L> root(Known<L> const& a) {
  L const zero(0.0);
  // Below zero the root is undefined, and what is made of it need not be continuous.
  auto const partly = a.v.low < zero;
  L const low = lane::max(zero, a.v.low), high = lane::max(zero, a.v.high);
  Span<L> v = widened(lane::sqrt(low), lane::sqrt(high));
  v.low = lane::max(zero, v.low);
  auto const off = zero < v.low;
  Span<L> const rate = select(off, 0.5 * reciprocal(v), Span<L>{L(0.0), L(all)});
  auto const still = lane::both(a.d.low == zero, a.d.high == zero);
  Span<L> const d =
      select(partly, Span<L>{L(-all), L(all)}, select(still, Span<L>{zero, zero}, rate * a.d));
  L const c = lane::sqrt(a.c);
  // Where it is steep: sqrt(c + e) - sqrt(c) is sqrt(e) at most.
  L const e = lane::min(error_of(rate, a.e, c, 1), lane::sqrt(a.e) + L(2 * ulp) * c);
  return {v, d, c, e};
}
/// @param turned the cosine
template <class L>
Known<L> sine(Known<L> const& a, bool turned) {
  L const s = lane::sin(a.c), k = lane::cos(a.c);
  L const reach = lane::max(a.v.high - a.c, a.c - a.v.low) * L(1 + 4 * ulp), one(1.0);
  auto const about = [&](L const& at, L const& rate) {
    L const off = (lane::abs(rate) + L(0.5) * reach) * reach + L(library * ulp);
    Span<L> const out = widened(at - off, at + off, library);
    return Span<L>{lane::max(-one, out.low), lane::min(one, out.high)};
  };
  Span<L> const sines = about(s, k), cosines = about(k, s);
  Span<L> const rate = turned ? -sines : cosines;
  L const c = turned ? k : s;
  return {turned ? cosines : sines, rate * a.d, c, a.e + L(library * ulp)};
}
template <class L>
Known<L> power_of_e(Known<L> const& a) {
  Span<L> v = widened(lane::exp(a.v.low), lane::exp(a.v.high), library);
  v.low = lane::max(L(0.0), v.low);
  L const c = lane::exp(a.c);
  return {v, v * a.d, c, error_of(v, a.e, c, library)};
}
template <class L>
Known<L> whole_power(Known<L> const& a, int n) {
  auto const raised = [](L const& x, int times) {
    L out = x;
    for (int i = 1; i < times; ++i) out = out * x;
    return out;
  };
  auto const over = [&](int times) {
    Span<L> const base = times % 2 == 0 ? abs(a.v) : a.v;
    Span<L> out =
        widened(raised(base.low, times), raised(base.high, times), library_power + 2 * times);
    if (times % 2 == 0) out.low = lane::max(L(0.0), out.low);
    return out;
  };
  Span<L> const rate = static_cast<double>(n) * over(n - 1);
  L const c = raised(a.c, n);
  return {over(n), rate * a.d, c, error_of(rate, a.e, c, library_power + 2 * n)};
}
/// The angle of x, y.
template <class L>
Known<L> angle(Known<L> const& y, Known<L> const& x) {
  L const zero(0.0), half_turn(3.14159265358979323846 * (1 + 2 * ulp));
  auto const cut = lane::both(x.v.low <= zero, lane::both(y.v.low <= zero, zero <= y.v.high));
  Span<L> const inverse = reciprocal(square(x.v) + square(y.v));
  Span<L> const by_y = x.v * inverse, by_x = -(y.v * inverse);
  L const c = lane::atan2(y.c, x.c);
  auto const reach = [&](Known<L> const& of) {
    return lane::max(of.v.high - of.c, of.c - of.v.low);
  };
  L const off =
      (size(by_y) * reach(y) + size(by_x) * reach(x)) * L(1 + 8 * ulp) + L(4 * library * ulp);
  Span<L> const all_round{-half_turn, half_turn};
  Span<L> const near = widened(c - off, c + off);
  L const e = (size(by_y) * y.e + size(by_x) * x.e) * L(1 + 8 * ulp) + L(4 * library * ulp);
  return {select(cut, all_round,
                 Span<L>{lane::max(-half_turn, near.low), lane::min(half_turn, near.high)}),
          select(cut, Span<L>{L(-all), L(all)}, y.d * by_y + x.d * by_x), c,
          lane::select(cut, half_turn + half_turn, e)};
}
/// The lesser or the greater. What is undefined has an infinite slope, and may be either of them:
/// of a number and of what is none, the second counts where less is wanted, else the first.
template <class L>
Known<L> chosen(Known<L> const& a, Known<L> const& b, bool less) {
  auto const below = a.v.high < b.v.low, above = b.v.high < a.v.low;
  auto const first = less ? below : above, second = less ? above : below;
  Span<L> const own = less ? Span<L>{lane::min(a.v.low, b.v.low), lane::min(a.v.high, b.v.high)}
                           : Span<L>{lane::max(a.v.low, b.v.low), lane::max(a.v.high, b.v.high)};
  auto const sound = lane::both(size(a.d) < L(all), size(b.d) < L(all));
  auto const lower = a.c < b.c;
  // A value that is undefined in the middle is not chosen there.
  auto const known = [](L const& e) { return lane::select(e == e, e, L(0.0)); };
  return {select(sound, own, hull(a.v, b.v)),
          select(sound, select(first, a.d, select(second, b.d, hull(a.d, b.d))),
                 Span<L>{L(-all), L(all)}),
          less ? lane::select(lower, a.c, b.c) : lane::select(lower, b.c, a.c),
          lane::max(known(a.e), known(b.e))};
}

} // namespace abbe::field
