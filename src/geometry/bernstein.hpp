// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

/// Pieces of polynomials in Bernstein form: what the isolation of roots (roots.cpp) works on.
namespace abbe::geometry {

/// Bernstein coefficients over [low, low + width], their error, and the signs at the ends.
template <class N>
struct Piece {
  N low;
  double width, error;
  int first, last;
  std::array<N, largest_degree + 1> b;
};

/// b_j = sum C(j, i) / C(n, i) c_i: all weights within [0, 1].
template <class N>
void to_bernstein(Polynomial<N> const& f, Piece<N>& piece) {
  int const n = f.degree;
  double binomial = 1, size = 0;
  for (int i = 0; i <= n; ++i) {
    auto const k = static_cast<std::size_t>(i);
    size += std::fabs(rounded(f.c[k]));
    double const inverse = 1 / binomial; // binomials up to C(35, 17) are exact
    if constexpr (std::is_same_v<N, double>) {
      piece.b[k] = f.c[k] * inverse;
    } else {
      // With twice the digits: one step of Newton.
      N const rest = N(1.0) - N(inverse) * N(binomial);
      piece.b[k] = f.c[k] * (N(inverse) + N(inverse) * rest);
    }
    binomial = std::round(binomial * (n - i) / (i + 1));
  }
  for (int i = 1; i <= n; ++i) {
    for (int j = n; j >= i; --j) {
      auto const k = static_cast<std::size_t>(j);
      piece.b[k] = piece.b[k] + piece.b[k - 1];
    }
  }
  piece.error = f.error + 2 * (n + 3) * roundoff<N> * size;
}

/// Parts `whole` at `share` of its width.
template <class N>
void part(Piece<N> const& whole, int n, double share, Piece<N>& left, Piece<N>& right) {
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
template <class N>
Changes changes(Piece<N> const& piece, int n) {
  Changes result;
  int last = piece.first, open = 0;
  for (int i = 1; i <= n; ++i) {
    double const b = rounded(piece.b[static_cast<std::size_t>(i)]);
    int const sign = i == n ? piece.last : (b > piece.error ? 1 : (b < -piece.error ? -1 : 0));
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
