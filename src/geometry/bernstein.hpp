// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

/// Pieces of polynomials in Bernstein form: what the isolation of roots (roots.cpp) works on.
/// `Degree` is that of all polynomials of a search, so that loops are unrolled; 0: any.
namespace abbe::geometry {

/// Bernstein coefficients over [low, low + width], their error, and the signs at the ends.
template <class N, int Degree>
struct Piece {
  N low;
  double width, error;
  int first, last;
  std::array<N, (Degree > 0 ? Degree : largest_degree) + 1> b;
};

template <int Degree, class N>
int degree_of(Polynomial<N> const& f) {
  if constexpr (Degree > 0)
    return Degree;
  else
    return f.degree;
}

/// C(n, i) and its inverse; those up to C(35, 17) are exact.
struct Binomials {
  double of[largest_degree + 1][largest_degree + 1],
      inverse[largest_degree + 1][largest_degree + 1];
  constexpr Binomials() : of(), inverse() {
    for (int n = 0; n <= largest_degree; ++n) {
      std::uint64_t value = 1;
      for (int i = 0; i <= n; ++i) {
        of[n][i] = static_cast<double>(value);
        inverse[n][i] = 1 / of[n][i];
        value = value * static_cast<std::uint64_t>(n - i) / static_cast<std::uint64_t>(i + 1);
      }
    }
  }
};
inline constexpr Binomials binomials;

/// Over [0, 1] or, `below`, [-1, 0]: b_j = sum C(j, i) / C(n, i) c_i, all weights within [0, 1].
template <class N, int Degree>
void to_bernstein(Polynomial<N> const& f, bool below, Piece<N, Degree>& piece) {
  int const n = degree_of<Degree>(f);
  double size = 0;
  piece.low = N(below ? -1.0 : 0.0);
  piece.width = 1;
  for (int i = 0; i <= n; ++i) {
    auto const k = static_cast<std::size_t>(i);
    size += std::fabs(rounded(f.c[k]));
    double const inverse = binomials.inverse[n][i];
    if constexpr (std::is_same_v<N, double>) {
      piece.b[k] = f.c[k] * inverse;
    } else {
      // With twice the digits: one step of Newton.
      N const rest = N(1.0) - N(inverse) * N(binomials.of[n][i]);
      piece.b[k] = f.c[k] * (N(inverse) + N(inverse) * rest);
    }
    if (below && i % 2 == 1) piece.b[k] = -piece.b[k];
  }
  for (int i = 1; i <= n; ++i) {
    for (int j = n; j >= i; --j) {
      auto const k = static_cast<std::size_t>(j);
      piece.b[k] = piece.b[k] + piece.b[k - 1];
    }
  }
  if (below) std::reverse(piece.b.begin(), piece.b.begin() + n + 1);
  piece.error = f.error + 2 * (n + 3) * roundoff<N> * size;
}

/// Parts `whole` at `share` of its width.
template <class N, int Degree>
void part(Piece<N, Degree> const& whole, int n, double share, Piece<N, Degree>& left,
          Piece<N, Degree>& right) {
  double size = 0;
  for (int i = 0; i <= n; ++i) {
    auto const k = static_cast<std::size_t>(i);
    size = std::max(size, std::fabs(rounded(whole.b[k])));
    right.b[k] = whole.b[k];
  }
  N const by(share);
  for (int i = 0; i <= n; ++i) {
    left.b[static_cast<std::size_t>(i)] = right.b[0];
    for (int j = 0; j < n - i; ++j) {
      auto const k = static_cast<std::size_t>(j);
      right.b[k] = share == 0.5 ? N(0.5) * (right.b[k] + right.b[k + 1])
                                : right.b[k] + by * (right.b[k + 1] - right.b[k]);
    }
  }
  double const error = whole.error + 4 * (n + 1) * roundoff<N> * size;
  left.low = whole.low;
  left.width = share * whole.width;
  left.first = whole.first;
  right.low = whole.low + N(left.width);
  right.width = whole.width - left.width;
  right.last = whole.last;
  left.error = right.error = error;
}

struct Changes {
  int count = 0;
  bool certain = true; ///< whatever the signs of the coefficients within the error
};
template <class N, int Degree>
Changes changes(Piece<N, Degree> const& piece, int n) {
  // Most pieces have none.
  bool same = piece.first == piece.last;
  double const side = piece.first;
  for (int i = 1; i < n; ++i)
    same = same & (side * rounded(piece.b[static_cast<std::size_t>(i)]) > piece.error);
  Changes result;
  if (same) return result;
  int last = piece.first, open = 0;
  for (int i = 1; i <= n; ++i) {
    double const b = rounded(piece.b[static_cast<std::size_t>(i)]);
    int const sign = i == n ? piece.last : sign_of(b, piece.error);
    if (sign == 0) {
      ++open;
      continue;
    }
    result.count += sign != last;
    result.certain = result.certain && (open == 0 || (open == 1 && sign != last));
    open = 0;
    last = sign;
  }
  return result;
}

} // namespace abbe::geometry
