// SPDX-License-Identifier: MIT
#include "geometry/roots.hpp"

#include "geometry/bernstein.hpp"
#include "geometry/shapes/bracket.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

namespace abbe::geometry {

namespace {

constexpr int most_halvings = 56;
constexpr int most_renewals = 25; // 2^-50 each

/// Value and first derivatives, by Horner's scheme.
template <int Degree, class N>
std::pair<double, double> value_and_slope(Polynomial<N> const& f, double s) {
  int const n = degree_of<Degree>(f);
  N value = f.c[static_cast<std::size_t>(n)];
  double slope = 0;
  for (int i = n; i-- > 0;) {
    auto const k = static_cast<std::size_t>(i);
    slope = slope * s + (i + 1) * rounded(f.c[k + 1]);
    value = value * N(s) + f.c[k];
  }
  return {rounded(value), slope};
}

template <class N, int Degree>
PolynomialRoot refined(Polynomial<N> const& f, Piece<N, Degree> const& piece) {
  int const n = degree_of<Degree>(f);
  PolynomialRoot root;
  root.rising = piece.first < 0;
  double const low = rounded(piece.low), high = rounded(piece.low + N(piece.width));
  double const at_low = rounded(piece.b[0]),
               at_high = rounded(piece.b[static_cast<std::size_t>(n)]);
  double const chord = low + piece.width * (at_low / (at_low - at_high));
  root.at = bracketed_root([&](double s) { return value_and_slope<Degree>(f, s); }, low, high,
                           root.rising, low < chord && chord < high ? chord : 0.5 * (low + high));
  double size = 0, slope = 0, bend = 0, third = 0;
  for (int i = n; i >= 0; --i) {
    double const c = rounded(f.c[static_cast<std::size_t>(i)]);
    size = size * std::fabs(root.at) + std::fabs(c);
    if (i >= 1) slope = slope * root.at + i * c;
    if (i >= 2) bend = bend * root.at + i * (i - 1) * c;
    if (i >= 3) third = third * root.at + i * (i - 1) * (i - 2) * c;
  }
  double const error = f.error + 2 * (n + 1) * roundoff<N> * size;
  root.slope = slope;
  root.bend = bend;
  root.error = std::min(root_uncertainty(error, slope, bend, third), std::max(piece.width, 0.0))
               + 2 * unit_roundoff * std::fabs(root.at);
  return root;
}

/// A piece [low, low + width] of what the search began with, and how to make its polynomial anew.
template <class N>
struct Place {
  Polynomial<N> const& whole;
  PieceMaker const* make = nullptr; ///< else `whole` is shifted
  double turn = 1;                  ///< -1: `whole` is the mirror image of what `make` knows
  bool inverse = false; ///< `whole` is of 1 / s, times s^degree; roots come as s, descending
  N low = N(0.0);
  double width = 1;
  int renewals = 0;

  N at(N const& s) const { return renewals == 0 ? s : low + N(width) * s; }
};

/// The one root in a piece, as the search's caller counts.
template <class N, int Degree>
PolynomialRoot only_root(Polynomial<N> const& f, Place<N> const& place,
                         Piece<N, Degree> const& piece) {
  PolynomialRoot root = refined(f, piece);
  if (place.renewals > 0) {
    root.at = rounded(place.at(N(root.at)));
    root.error = place.width * root.error + 2 * unit_roundoff * std::fabs(root.at);
    root.slope /= place.width;
    root.bend /= place.width * place.width;
  }
  if (!place.inverse) return root;
  double const w = root.at;
  root.at = 1 / w;
  root.error = root.error / w / w + unit_roundoff * std::fabs(root.at);
  // What was searched is f / s^degree.
  if (!(w < 0 && place.whole.degree % 2 == 1)) root.rising = !root.rising;
  root.slope = root.bend = 0;
  for (int k = place.whole.degree; k >= 1; --k) {
    double const c = rounded(place.whole.c[static_cast<std::size_t>(place.whole.degree - k)]);
    root.slope = root.slope * root.at + k * c;
    if (k >= 2) root.bend = root.bend * root.at + k * (k - 1) * c;
  }
  return root;
}

/// f(low + width s), by Horner's scheme. Its terms are at most those of the sum of |c_i| high^i.
template <class N>
Polynomial<N> shifted(Polynomial<N> f, N const& low, double width, double size) {
  int const n = f.degree;
  for (int i = 0; i < n; ++i) {
    for (int j = n; j-- > i;) {
      auto const k = static_cast<std::size_t>(j);
      f.c[k] = f.c[k] + low * f.c[k + 1];
    }
  }
  N power(1.0);
  for (int i = 1; i <= n; ++i) {
    power = power * N(width);
    f.c[static_cast<std::size_t>(i)] = power * f.c[static_cast<std::size_t>(i)];
  }
  f.error += 4 * (n + 1) * roundoff<N> * size;
  return f;
}

/// The polynomial of a piece made anew, at its own size: halving keeps the error of [0, 1], which
/// buries what is small. `place` becomes that of the piece.
/// @param small: as narrow as this search goes, whatever the error
/// @return false: that would tell no more
template <class N, int Degree>
bool renew(Place<N>& place, Piece<N, Degree> const& piece, bool small, Polynomial<N>& out) {
  if (place.renewals >= most_renewals) return false;
  N const low = place.at(piece.low);
  double const width = place.width * piece.width;
  double size = 0;
  if (place.make != nullptr) {
    if constexpr (!std::is_same_v<N, double>)
      out = (*place.make)(N(place.turn) * low, place.turn * width);
    for (int i = 0; i <= out.degree; ++i)
      size += std::fabs(rounded(out.c[static_cast<std::size_t>(i)]));
  } else {
    int const n = place.whole.degree;
    double const high = std::max(std::fabs(rounded(low)), std::fabs(rounded(low) + width));
    for (int i = n; i >= 0; --i)
      size = size * high + std::fabs(rounded(place.whole.c[static_cast<std::size_t>(i)]));
    double const given = place.whole.error * std::max(1.0, simd::pow(high, static_cast<double>(n)));
    double const error = given + 8 * (n + 1) * roundoff<N> * size;
    if (!small && !(error < 0.25 * piece.error)) return false;
    out = shifted(place.whole, low, width, size);
    out.error += given - place.whole.error;
  }
  place.low = low;
  place.width = width;
  ++place.renewals;
  return small || out.error + 2 * (out.degree + 3) * roundoff<N> * size < 0.25 * piece.error;
}

template <int Degree, class N>
bool isolate(Polynomial<N> const& f, Place<N> const& place, bool below, int first, int last,
             PolynomialRoots& roots, Wanted* wanted = nullptr);

/// What is in a piece whose digits ran out.
/// @return false: doubles leave it open
template <class N, int Degree>
bool isolate_closer(Polynomial<N> const& f, Place<N> const& place, Piece<N, Degree> const& piece,
                    bool small, PolynomialRoots& roots) {
  Place<N> closer = place;
  Polynomial<N> anew{};
  if (!renew(closer, piece, small, anew)) {
    if (std::is_same_v<N, double>) return false;
    // Beyond the digits of the coefficients: the fewest roots that the ends allow.
    if (piece.first != piece.last) roots.add(only_root(f, place, piece));
    return true;
  }
  return isolate<0>(anew, closer, false, piece.first, piece.last, roots);
}

/// @param below in [-1, 0], else in [0, 1]; the signs are those at the ends
template <int Degree, class N>
bool isolate(Polynomial<N> const& f, Place<N> const& place, bool below, int first, int last,
             PolynomialRoots& roots, Wanted* wanted) {
  int const n = degree_of<Degree>(f);
  if (first == 0 || last == 0) return false;
  if (n == 0) return true;
  int const before = roots.count;
  // Waiting pieces, the leftmost on top; each halving adds one.
  Piece<N, Degree> waiting[most_halvings + 4], right;
  int top = 0;
  to_bernstein(f, below, waiting[0]);
  waiting[0].first = first;
  waiting[0].last = last;
  while (top >= 0) {
    Piece<N, Degree>& piece = waiting[top];
    Changes const seen = changes(piece, n);
    double const low = rounded(piece.low);
    if ((seen.count == 0 && seen.certain)
        || (wanted != nullptr && !wanted->any_in(low, low + piece.width))) {
      --top;
      continue;
    }
    if (seen.count == 1 && seen.certain) {
      PolynomialRoot const root = only_root(f, place, piece);
      roots.add(root);
      if (wanted != nullptr) wanted->found(root);
      --top;
      continue;
    }
    bool parted = false;
    bool const small = top >= most_halvings || !(piece.width > 0x1p-50);
    if (!small) {
      Piece<N, Degree>& left = waiting[top + 1];
      // Doubles have somebody to ask. Many roots in a place leave a wide stretch around it unclear.
      constexpr double shares[] = {0.5, 0.4375, 0.625, 0.25, 0.75, 0.125, 0.875};
      for (double const share : std::span(shares, std::is_same_v<N, double> ? 3 : 7)) {
        part(piece, n, share, left, right);
        double const middle = rounded(right.b[0]);
        left.last = right.first = middle > left.error ? 1 : (middle < -left.error ? -1 : 0);
        parted = left.last != 0;
        if (parted) break;
      }
    }
    if (parted) {
      waiting[top++] = right;
      continue;
    }
    if (!isolate_closer(f, place, piece, small, roots)) {
      roots.count = before;
      return false;
    }
    --top;
  }
  return true;
}

/// work(degree), which is a constant where it is one of those that shapes often have, else 0.
template <class Work>
bool with_degree(int degree, Work const& work) {
  switch (degree) {
  case 2:
    return work(std::integral_constant<int, 2>());
  case 3:
    return work(std::integral_constant<int, 3>());
  case 4:
    return work(std::integral_constant<int, 4>());
  case 6:
    return work(std::integral_constant<int, 6>());
  default:
    return work(std::integral_constant<int, 0>());
  }
}

/// f(-s)
Polynomial<Twofold> mirrored(Polynomial<Twofold> f) {
  for (int i = 1; i <= f.degree; i += 2)
    f.c[static_cast<std::size_t>(i)] = -f.c[static_cast<std::size_t>(i)];
  return f;
}
/// s^degree f(1 / s)
template <int Degree, class N>
Polynomial<N> reversed(Polynomial<N> const& f) {
  Polynomial<N> out;
  out.degree = degree_of<Degree>(f);
  out.error = f.error;
  for (int i = 0; i <= out.degree; ++i)
    out.c[static_cast<std::size_t>(out.degree - i)] = f.c[static_cast<std::size_t>(i)];
  return out;
}

PolynomialRoot mirrored(PolynomialRoot root) {
  root.at = -root.at;
  root.slope = -root.slope;
  root.rising = !root.rising;
  return root;
}

/// The least k for which all roots are within 2^k (Fujiwara).
int exponent_of_roots(Polynomial<Twofold> const& f) {
  auto const exponent = [&](int i) {
    double const c = rounded(f.c[static_cast<std::size_t>(i)]);
    return c == 0 ? -100000 : std::ilogb(c);
  };
  int const n = f.degree, top = exponent(n);
  int most = -1000;
  for (int i = 1; i <= n; ++i) {
    int const ratio = exponent(n - i) - top + 1;
    most = std::max(most, ratio > 0 ? (ratio + i - 1) / i : -(-ratio / i));
  }
  int const limit = 900 / n; // of what powers of it can be held
  return std::clamp(most + 1, -limit, limit);
}

} // namespace

double root_uncertainty(double error, double slope, double bend, double third) {
  if (!(error > 0)) return 0;
  double steep = std::max(std::fabs(slope), std::sqrt(2 * std::fabs(bend) * error));
  double const triple = 4 * error * error * std::fabs(third);
  if (!(triple <= steep * steep * steep)) steep = std::max(steep, simd::cbrt(triple));
  return 2 * error / steep;
}

bool unit_roots(Polynomial<double> const& f, int first, int last, PolynomialRoots& roots,
                Wanted wanted) {
  return with_degree(f.degree, [&](auto degree) {
    return isolate<degree()>(f, Place<double>{f}, false, first, last, roots, &wanted);
  });
}
bool unit_roots(Polynomial<Twofold> const& f, int first, int last, PolynomialRoots& roots) {
  return isolate<0>(f, Place<Twofold>{f}, false, first, last, roots);
}

namespace {

template <int Degree>
bool line_roots_of(Polynomial<double> const& f, PolynomialRoots& roots, Wanted wanted) {
  int const n = degree_of<Degree>(f);
  double one = 0, minus_one = 0;
  for (int i = n; i >= 0; --i) {
    double const c = f.c[static_cast<std::size_t>(i)];
    one += c;
    minus_one += i % 2 == 0 ? c : -c;
  }
  int const end = sign_of(f.c[static_cast<std::size_t>(n)], f.error),
            zero = sign_of(f.c[0], f.error), above = sign_of(one, 2 * f.error),
            below = sign_of(minus_one, 2 * f.error);
  if (end == 0 || zero == 0 || above == 0 || below == 0) return false;
  // Of 1 / s, whose polynomial is that of s from the other end: below -1, above 1.
  Polynomial<double> const inverse = reversed<Degree>(f);
  Place<double> beyond{inverse};
  beyond.inverse = true;
  Place<double> const near{f};
  PolynomialRoots part;
  auto const search_beyond = [&](bool negative) {
    part.count = 0;
    bool const good =
        negative ? isolate<Degree>(inverse, beyond, true, n % 2 == 1 ? -below : below, end, part)
                 : isolate<Degree>(inverse, beyond, false, end, above, part);
    for (int i = part.count; good && i-- > 0;) // they come descending
      if (PolynomialRoot const& root = part.root[static_cast<std::size_t>(i)];
          std::isfinite(root.at)) { // else the line's end
        roots.add(root);
        wanted.found(root);
      }
    return good;
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  int const before = roots.count;
  bool good = true;
  if (wanted.any_in(-infinite, -1)) good = search_beyond(true);
  if (good && wanted.any_in(-1, 0))
    good = isolate<Degree>(f, near, true, below, zero, roots, &wanted);
  if (good && wanted.any_in(0, 1))
    good = isolate<Degree>(f, near, false, zero, above, roots, &wanted);
  if (good && wanted.any_in(1, infinite)) good = search_beyond(false);
  if (!good) roots.count = before;
  return good;
}

} // namespace

bool line_roots(Polynomial<double> const& f, PolynomialRoots& roots, Wanted wanted) {
  int degree = f.degree;
  while (degree > 0 && f.c[static_cast<std::size_t>(degree)] == 0) --degree;
  if (degree == 0) return true;
  if (degree != f.degree) {
    Polynomial<double> less = f;
    less.degree = degree;
    return line_roots(less, roots, wanted);
  }
  return with_degree(degree, [&](auto known) { return line_roots_of<known()>(f, roots, wanted); });
}

void line_roots(Polynomial<Twofold> f, PieceMaker const& make, PolynomialRoots& roots) {
  constexpr int far = 20; // 2^20: there a leading coefficient's error is its own
  int const full_degree = f.degree;
  double leading_error = f.error;
  if (make) {
    leading_error =
        std::min(leading_error,
                 std::ldexp(make(Twofold(0.0), std::ldexp(1.0, far)).error, -far * full_degree));
  }
  while (f.degree > 0
         && !(std::fabs(rounded(f.c[static_cast<std::size_t>(f.degree)])) > leading_error))
    --f.degree;
  if (f.degree == 0) return;
  // In a unit that holds all roots.
  int const exponent = exponent_of_roots(f);
  double const unit = std::ldexp(1.0, exponent);
  Polynomial<Twofold> g = f;
  if (make) {
    g = make(Twofold(0.0), unit);
    g.degree = f.degree;
  } else {
    for (int i = 0; i <= f.degree; ++i) {
      auto const k = static_cast<std::size_t>(i);
      g.c[k] = Twofold(std::ldexp(1.0, exponent * i)) * f.c[k];
    }
    g.error = f.error * std::max(1.0, simd::pow(unit, static_cast<double>(f.degree)));
  }
  int const zero = sign_of(g.c[0], 0);
  for (bool const mirror : {true, false}) {
    Polynomial<Twofold> const whole = mirror ? mirrored(f) : f;
    Polynomial<Twofold> const near = mirror ? mirrored(g) : g;
    Place<Twofold> place{whole};
    place.make = make ? &make : nullptr;
    place.turn = mirror ? -1 : 1;
    place.width = unit;
    place.renewals = 1;
    PolynomialRoots part;
    isolate<0>(near, place, false, zero, sign_of(near.at_one(), 0), part);
    for (int i = 0; i < part.count; ++i) {
      PolynomialRoot const& root =
          part.root[static_cast<std::size_t>(mirror ? part.count - 1 - i : i)];
      if (std::isfinite(root.at)) roots.add(mirror ? mirrored(root) : root); // else the line's end
    }
  }
}

} // namespace abbe::geometry
