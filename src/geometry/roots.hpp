// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/twofold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

/// All real roots of polynomials whose coefficients carry bounds of their errors (research 3.3).
///
/// Roots are isolated by Descartes' rule of signs on Bernstein coefficients: their signs change at
/// least as often as the polynomial has roots, by an even excess; 0 and 1 changes are certain, else
/// the interval is halved (de Casteljau). Each interval keeps the bound of its coefficients'
/// errors; where that buries a piece's values, its polynomial is made anew at its own size, so
/// roots may be of any magnitudes. What doubles leave open is asked again of the same polynomial
/// made in Twofold numbers, so the count is right down to roots that are closer than the
/// coefficients' own digits tell; there it is the count of a polynomial within the error bounds.
namespace abbe::geometry {

inline constexpr int largest_degree = 35;

/// c[0] + c[1] s + ... + c[degree] s^degree; the errors of all coefficients together are at most
/// `error`.
template <class N>
struct Polynomial {
  int degree = 0;
  double error = 0;
  std::array<N, largest_degree + 1> c;

  N at(double s) const {
    N sum = c[static_cast<std::size_t>(degree)];
    for (int i = degree; i-- > 0;) sum = sum * N(s) + c[static_cast<std::size_t>(i)];
    return sum;
  }
  N at_one() const {
    N sum = c[0];
    for (int i = 1; i <= degree; ++i) sum = sum + c[static_cast<std::size_t>(i)];
    return sum;
  }
};

struct PolynomialRoot {
  double at;
  double error; ///< bound of its error
  double slope; ///< first and second derivative there
  double bend;
  bool rising; ///< from negative to positive
};
struct PolynomialRoots {
  std::array<PolynomialRoot, 4 * largest_degree> root;
  int count = 0;
  void add(PolynomialRoot const& r) {
    if (count < static_cast<int>(root.size())) root[static_cast<std::size_t>(count++)] = r;
  }
  PolynomialRoot const* begin() const { return root.data(); }
  PolynomialRoot const* end() const { return root.data() + count; }
};

/// +1 or -1; 0 when doubles leave it open. Twofold numbers decide always: zero is positive.
inline int sign_of(double value, double error) {
  return value > error ? 1 : (value < -error ? -1 : 0);
}
inline int sign_of(Twofold const& value, double) {
  return value.high < 0 || (value.high == 0 && value.low < 0) ? -1 : 1;
}

/// Which roots of a search are asked for.
class Wanted {
public:
  Wanted() = default; ///< all
  /// Those from `start` up to `end` or to the first, with a margin on both sides.
  Wanted(double start, double end, double margin)
      : from_(start - margin), to_(end + margin), ahead_(start + margin), margin_(margin) {}

  bool any_in(double low, double high) const { return high >= from_ && low <= to_; }
  void found(PolynomialRoot const& root) {
    if (root.at - root.error > ahead_) to_ = std::min(to_, root.at + root.error + margin_);
  }

private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double from_ = -infinite, to_ = infinite, ahead_ = infinite, margin_ = 0;
};

/// Appends the roots in (0, 1), ascending. `first` and `last` are the signs at 0 and 1, decided by
/// the caller, so that neighbouring pieces agree (0: none yet, of doubles only).
/// @return false, with nothing appended: doubles leave it open
bool unit_roots(Polynomial<double> const& f, int first, int last, PolynomialRoots& roots,
                Wanted wanted = {});
bool unit_roots(Polynomial<Twofold> const& f, int first, int last, PolynomialRoots& roots);

/// Appends the roots of the whole line, by way of 1 / s beyond [-1, 1].
/// @return as unit_roots
bool line_roots(Polynomial<double> const& f, PolynomialRoots& roots, Wanted wanted = {});

/// f(low + width s) with its error for |s| <= 1, from what f itself is made of; width may be
/// negative.
using PieceMaker = std::function<Polynomial<Twofold>(Twofold const& low, double width)>;

/// Appends the roots of the whole line. Leading coefficients within the error are taken for zero.
/// @param make empty: f itself is shifted, and the pieces have its error
void line_roots(Polynomial<Twofold> f, PieceMaker const& make, PolynomialRoots& roots);

/// The roots in (0, 1) of what `make(N{})` makes with double or Twofold coefficients, ascending.
template <class Make>
void unit_roots_of(Make const& make, PolynomialRoots& roots) {
  Polynomial<double> const f = make(double{});
  if (unit_roots(f, sign_of(f.c[0], f.error), sign_of(f.at_one(), f.error * 2), roots)) return;
  Polynomial<Twofold> const g = make(Twofold{});
  unit_roots(g, sign_of(g.c[0], 0), sign_of(g.at_one(), 0), roots);
}

/// Bound of how far a root moves when f is uncertain by `error`; knows simple, double and triple
/// roots.
double root_uncertainty(double error, double slope, double bend, double third);

/// A polynomial of a degree that its maker knows: what shapes make theirs of.
template <class N, int Degree>
struct Terms {
  double error = 0;
  std::array<N, Degree + 1> c;

  operator Polynomial<N>() const {
    Polynomial<N> f;
    f.degree = Degree;
    f.error = error;
    std::copy(c.begin(), c.end(), f.c.begin());
    return f;
  }
  /// Sum of the coefficients' sizes.
  double size() const {
    double sum = 0;
    for (N const& k : c) sum += std::fabs(rounded(k));
    return sum;
  }
};
template <class N>
Terms<N, 0> constant(N const& value, double error = 0) {
  return {error, {value}};
}

// Their errors cover those of what they are made of and the rounding.
template <class N, int F, int G>
Terms<N, F + G> product(Terms<N, F> const& f, Terms<N, G> const& g) {
  Terms<N, F + G> out;
  out.c.fill(N(0.0));
  for (std::size_t i = 0; i <= F; ++i)
    for (std::size_t j = 0; j <= G; ++j) out.c[i + j] = out.c[i + j] + f.c[i] * g.c[j];
  double const f_size = f.size(), g_size = g.size();
  out.error = f_size * g.error + f.error * (g_size + g.error)
              + 2 * (F + G + 2) * roundoff<N> * f_size * g_size;
  return out;
}
template <class N, int Degree>
Terms<N, Degree> times(N const& factor, Terms<N, Degree> f) {
  for (N& k : f.c) k = factor * k;
  f.error = f.error * std::fabs(rounded(factor)) + 4 * roundoff<N> * f.size();
  return f;
}
template <class N, int Degree>
Terms<N, Degree> operator-(Terms<N, Degree> f) {
  for (N& k : f.c) k = -k;
  return f;
}
template <class N, int F, int G>
Terms<N, std::max(F, G)> sum_of(Terms<N, F> const& f, Terms<N, G> const& g) {
  Terms<N, std::max(F, G)> out;
  for (std::size_t i = 0; i < out.c.size(); ++i)
    out.c[i] = i > G ? f.c[i] : (i > F ? g.c[i] : f.c[i] + g.c[i]);
  out.error = f.error + g.error + 4 * roundoff<N> * (out.size() + g.size());
  return out;
}
template <class N, int Degree>
Terms<N, std::max(Degree - 1, 0)> derivative_of(Terms<N, Degree> const& f) {
  Terms<N, std::max(Degree - 1, 0)> out;
  out.c[0] = N(0.0);
  for (std::size_t i = 1; i <= Degree; ++i) out.c[i - 1] = N(static_cast<double>(i)) * f.c[i];
  out.error = Degree * f.error + 4 * roundoff<N> * out.size();
  return out;
}

} // namespace abbe::geometry
