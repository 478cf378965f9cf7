// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/twofold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

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
  double at = 0;
  double error = 0; ///< bound of its error
  double slope = 0; ///< first and second derivative there
  double bend = 0;
  bool rising = false; ///< from negative to positive
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

/// Appends the roots in (0, 1), ascending. `first` and `last` are the signs at 0 and 1, decided by
/// the caller, so that neighbouring pieces agree (0: none yet, of doubles only).
/// @return false, with nothing appended: doubles leave it open
bool unit_roots(Polynomial<double> const& f, int first, int last, PolynomialRoots& roots);
bool unit_roots(Polynomial<Twofold> const& f, int first, int last, PolynomialRoots& roots);

/// Appends the roots of the whole line, by way of 1 / s beyond [-1, 1].
/// @return as unit_roots
bool line_roots(Polynomial<double> f, PolynomialRoots& roots);

/// f(low + width s) with its error for |s| <= 1, from what f itself is made of; width may be
/// negative.
using PieceMaker = std::function<Polynomial<Twofold>(Twofold const& low, double width)>;

/// Appends the roots of the whole line. Leading coefficients within the error are taken for zero.
/// @param make empty: f itself is shifted, and the pieces have its error
void line_roots(Polynomial<Twofold> f, PieceMaker const& make, PolynomialRoots& roots);

/// The roots in (0, 1) of what `make(N{})` makes with double or Twofold coefficients, ascending.
template <class Make>
void unit_roots_of(Make const& make, PolynomialRoots& roots) {
  auto const f = make(double{});
  if (unit_roots(f, sign_of(f.c[0], f.error), sign_of(f.at_one(), f.error * 2), roots)) return;
  auto const g = make(Twofold{});
  unit_roots(g, sign_of(g.c[0], 0), sign_of(g.at_one(), 0), roots);
}

/// Bound of how far a root moves when f is uncertain by `error`; knows simple, double and triple
/// roots.
double root_uncertainty(double error, double slope, double bend, double third);

// Arithmetic of polynomials; degrees must fit. Errors are the caller's: see `sizes`.
template <class N>
void add_to(Polynomial<N>& f, Polynomial<N> const& g) {
  for (int i = f.degree + 1; i <= g.degree; ++i) f.c[static_cast<std::size_t>(i)] = N(0.0);
  f.degree = std::max(f.degree, g.degree);
  for (int i = 0; i <= g.degree; ++i) {
    auto const k = static_cast<std::size_t>(i);
    f.c[k] = f.c[k] + g.c[k];
  }
  f.error += g.error;
}
/// The errors of the result cover those of both factors and the rounding.
template <class N>
Polynomial<N> product(Polynomial<N> const& f, Polynomial<N> const& g) {
  Polynomial<N> out;
  out.degree = f.degree + g.degree;
  for (int i = 0; i <= out.degree; ++i) out.c[static_cast<std::size_t>(i)] = N(0.0);
  double f_size = 0, g_size = 0;
  for (int j = 0; j <= g.degree; ++j)
    g_size += std::fabs(rounded(g.c[static_cast<std::size_t>(j)]));
  for (int i = 0; i <= f.degree; ++i) {
    auto const k = static_cast<std::size_t>(i);
    f_size += std::fabs(rounded(f.c[k]));
    for (int j = 0; j <= g.degree; ++j) {
      auto const l = static_cast<std::size_t>(j);
      out.c[k + l] = out.c[k + l] + f.c[k] * g.c[l];
    }
  }
  out.error = f_size * g.error + f.error * (g_size + g.error)
              + 2 * (out.degree + 2) * roundoff<N> * f_size * g_size;
  return out;
}
template <class N>
Polynomial<N> times(N const& factor, Polynomial<N> f) {
  double const size = std::fabs(rounded(factor));
  double sum = 0;
  for (int i = 0; i <= f.degree; ++i) {
    auto const k = static_cast<std::size_t>(i);
    f.c[k] = factor * f.c[k];
    sum += std::fabs(rounded(f.c[k]));
  }
  f.error = f.error * size + 4 * roundoff<N> * sum;
  return f;
}
/// f + g, with the error of the rounding.
template <class N>
Polynomial<N> sum_of(Polynomial<N> f, Polynomial<N> const& g) {
  add_to(f, g);
  double sum = 0;
  for (int i = 0; i <= f.degree; ++i) {
    auto const k = static_cast<std::size_t>(i);
    sum += std::fabs(rounded(f.c[k]));
    if (i <= g.degree) sum += std::fabs(rounded(g.c[k]));
  }
  f.error += 4 * roundoff<N> * sum;
  return f;
}
template <class N>
Polynomial<N> derivative_of(Polynomial<N> const& f) {
  Polynomial<N> out;
  out.degree = std::max(0, f.degree - 1);
  out.c[0] = N(0.0);
  for (int i = 1; i <= f.degree; ++i) {
    out.c[static_cast<std::size_t>(i - 1)] =
        N(static_cast<double>(i)) * f.c[static_cast<std::size_t>(i)];
  }
  out.error = f.degree * f.error;
  return out;
}

} // namespace abbe::geometry
