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

template <class N>
PolynomialRoot refined(Polynomial<N> const& f, Piece<N> const& piece) {
  auto const derivatives = [&](double s) {
    double first = 0, second = 0, third = 0;
    for (int i = f.degree; i >= 1; --i) {
      double const c = rounded(f.c[static_cast<std::size_t>(i)]);
      first = first * s + i * c;
      if (i >= 2) second = second * s + i * (i - 1) * c;
      if (i >= 3) third = third * s + i * (i - 1) * (i - 2) * c;
    }
    return std::array{first, second, third};
  };
  auto const value = [&](double s) {
    double first = 0;
    for (int i = f.degree; i >= 1; --i)
      first = first * s + i * rounded(f.c[static_cast<std::size_t>(i)]);
    return std::pair{rounded(f.at(s)), first};
  };
  PolynomialRoot root;
  root.rising = piece.first < 0;
  root.at =
      bracketed_root(value, rounded(piece.low), rounded(piece.low + N(piece.width)), root.rising);
  double size = 0;
  for (int i = f.degree; i >= 0; --i)
    size = size * std::fabs(root.at) + std::fabs(rounded(f.c[static_cast<std::size_t>(i)]));
  double const error = f.error + 2 * (f.degree + 1) * roundoff<N> * size;
  auto const [slope, bend, third] = derivatives(root.at);
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
  bool inverse = false;             ///< `whole` is of 1 / s; roots come as s, descending
  N low = N(0.0);
  double width = 1;
  int renewals = 0;

  N at(N const& s) const { return renewals == 0 ? s : low + N(width) * s; }
};

/// The one root in a piece, as the search's caller counts.
template <class N>
PolynomialRoot only_root(Polynomial<N> const& f, Place<N> const& place, Piece<N> const& piece) {
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
  root.rising = !root.rising;
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
template <class N>
bool renew(Place<N>& place, Piece<N> const& piece, bool small, Polynomial<N>& out) {
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
    double const high = rounded(low) + width;
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

template <class N>
bool isolate(Polynomial<N> const& f, Place<N> const& place, int first, int last,
             PolynomialRoots& roots);

/// What is in a piece whose digits ran out.
/// @return false: doubles leave it open
template <class N>
bool isolate_closer(Polynomial<N> const& f, Place<N> const& place, Piece<N> const& piece,
                    bool small, PolynomialRoots& roots) {
  Place<N> closer = place;
  Polynomial<N> anew;
  if (!renew(closer, piece, small, anew)) {
    if (std::is_same_v<N, double>) return false;
    // Beyond the digits of the coefficients: the fewest roots that the ends allow.
    if (piece.first != piece.last) roots.add(only_root(f, place, piece));
    return true;
  }
  return isolate(anew, closer, piece.first, piece.last, roots);
}

template <class N>
bool isolate(Polynomial<N> const& f, Place<N> const& place, int first, int last,
             PolynomialRoots& roots) {
  int const n = f.degree;
  if (first == 0 || last == 0) return false;
  if (n == 0) return true;
  int const before = roots.count;
  // Waiting pieces, the leftmost on top; each halving adds one.
  Piece<N> waiting[most_halvings + 4];
  int top = 0;
  to_bernstein(f, waiting[0]);
  waiting[0].low = N(0.0);
  waiting[0].width = 1;
  waiting[0].first = first;
  waiting[0].last = last;
  while (top >= 0) {
    Piece<N>& piece = waiting[top];
    Changes const seen = changes(piece, n);
    if (seen.count == 0 && seen.certain) {
      --top;
      continue;
    }
    if (seen.count == 1 && seen.certain) {
      roots.add(only_root(f, place, piece));
      --top;
      continue;
    }
    bool parted = false;
    bool const small = top >= most_halvings || !(piece.width > 0x1p-50);
    Piece<N> left, right;
    if (!small) {
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
      waiting[top] = right;
      waiting[++top] = left;
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

/// f(-s)
template <class N>
Polynomial<N> mirrored(Polynomial<N> f) {
  for (int i = 1; i <= f.degree; i += 2)
    f.c[static_cast<std::size_t>(i)] = -f.c[static_cast<std::size_t>(i)];
  return f;
}
/// s^degree f(1 / s)
template <class N>
Polynomial<N> reversed(Polynomial<N> f) {
  std::reverse(f.c.begin(), f.c.begin() + f.degree + 1);
  return f;
}

PolynomialRoot mirrored(PolynomialRoot root) {
  root.at = -root.at;
  root.slope = -root.slope;
  root.rising = !root.rising;
  return root;
}

void take(PolynomialRoots const& part, bool turned, bool mirror, PolynomialRoots& roots) {
  for (int i = 0; i < part.count; ++i) {
    PolynomialRoot const& root =
        part.root[static_cast<std::size_t>(turned ? part.count - 1 - i : i)];
    if (std::isfinite(root.at)) roots.add(mirror ? mirrored(root) : root); // else the line's end
  }
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
  double const triple = simd::cbrt(4 * error * error * std::fabs(third));
  double const steep =
      std::max(std::max(std::fabs(slope), std::sqrt(2 * std::fabs(bend) * error)), triple);
  return 2 * error / steep;
}

bool unit_roots(Polynomial<double> const& f, int first, int last, PolynomialRoots& roots) {
  return isolate(f, Place<double>{f}, first, last, roots);
}
bool unit_roots(Polynomial<Twofold> const& f, int first, int last, PolynomialRoots& roots) {
  return isolate(f, Place<Twofold>{f}, first, last, roots);
}
bool line_roots(Polynomial<double> f, PolynomialRoots& roots) {
  auto const leading = [&] { return f.c[static_cast<std::size_t>(f.degree)]; };
  while (f.degree > 0 && leading() == 0) --f.degree;
  if (f.degree == 0) return true;
  Polynomial<double> const g = mirrored(f);
  int const end = sign_of(leading(), f.error), zero = sign_of(f.c[0], f.error),
            one = sign_of(f.at_one(), 2 * f.error), minus_one = sign_of(g.at_one(), 2 * f.error);
  if (end == 0 || zero == 0 || one == 0 || minus_one == 0) return false;
  int const begin = f.degree % 2 == 0 ? end : -end;
  PolynomialRoots part;
  int const before = roots.count;
  auto const search = [&](bool mirror, bool inverse, int first, int last) {
    part.count = 0;
    Polynomial<double> const whole = inverse ? reversed(mirror ? g : f) : (mirror ? g : f);
    Place<double> place{whole};
    place.inverse = inverse;
    if (!isolate(whole, place, first, last, part)) return false;
    take(part, mirror != inverse, mirror, roots); // both turn the order round
    return true;
  };
  bool const good = search(true, true, begin, minus_one) && search(true, false, zero, minus_one)
                    && search(false, false, zero, one) && search(false, true, end, one);
  if (!good) roots.count = before;
  return good;
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
    isolate(near, place, zero, sign_of(near.at_one(), 0), part);
    take(part, mirror, mirror, roots);
  }
}

} // namespace abbe::geometry
