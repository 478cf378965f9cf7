// SPDX-License-Identifier: MIT
#include "geometry/roots.hpp"

#include "geometry/shapes/bracket.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace abbe::geometry {

namespace {

constexpr int most_halvings = 56;

/// Bernstein coefficients over [low, low + width], their error, and the signs at the ends.
template <class N>
struct Piece {
  double low, width, error;
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
  double const middle = whole.low + share * whole.width;
  left.low = whole.low;
  left.width = middle - whole.low;
  left.first = whole.first;
  right.low = middle;
  right.width = whole.low + whole.width - middle;
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
  double const high = piece.low + piece.width;
  root.at = bracketed_root(value, piece.low, high, root.rising);
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

template <class N>
bool isolate(Polynomial<N> const& f, int first, int last, PolynomialRoots& roots) {
  constexpr bool last_word = !std::is_same_v<N, double>;
  int const n = f.degree;
  if (first == 0 || last == 0) return false;
  if (n == 0) return true;
  int const before = roots.count;
  // Waiting pieces, the leftmost on top; each halving adds one.
  Piece<N> waiting[most_halvings + 4];
  int top = 0;
  to_bernstein(f, waiting[0]);
  waiting[0].low = 0;
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
      roots.add(refined(f, piece));
      --top;
      continue;
    }
    bool parted = false;
    Piece<N> left, right;
    if (top < most_halvings && piece.width > 0x1p-50) {
      for (double const share : {0.5, 0.4375, 0.625}) {
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
    if (!last_word) {
      roots.count = before;
      return false;
    }
    // Beyond the digits of the coefficients: the fewest roots that the ends allow.
    if (piece.first != piece.last) roots.add(refined(f, piece));
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

template <class N>
bool whole_line(Polynomial<N> f, PolynomialRoots& roots) {
  constexpr bool last_word = !std::is_same_v<N, double>;
  auto const leading = [&] { return rounded(f.c[static_cast<std::size_t>(f.degree)]); };
  while (f.degree > 0 && (leading() == 0 || (last_word && std::fabs(leading()) <= f.error))) {
    --f.degree;
  }
  if (f.degree == 0) return true;
  Polynomial<N> const g = mirrored(f);
  int const end = sign_of(f.c[static_cast<std::size_t>(f.degree)], f.error);
  int const zero = sign_of(f.c[0], f.error), one = sign_of(f.at_one(), 2 * f.error),
            minus_one = sign_of(g.at_one(), 2 * f.error);
  if (end == 0 || zero == 0 || one == 0 || minus_one == 0) return false;
  int const begin = f.degree % 2 == 0 ? end : -end;
  PolynomialRoots part;
  int const before = roots.count;
  auto const take = [&](bool mirror, bool reverse, int first, int last) {
    part.count = 0;
    Polynomial<N> const& base = mirror ? g : f;
    if (!isolate(reverse ? reversed(base) : base, first, last, part)) return false;
    for (int i = 0; i < part.count; ++i) {
      // Both turn the order round.
      PolynomialRoot root =
          part.root[static_cast<std::size_t>(mirror != reverse ? part.count - 1 - i : i)];
      if (reverse) {
        double const w = root.at;
        if (w == 0) continue;
        root.at = 1 / w;
        root.error = root.error / w / w + unit_roundoff * std::fabs(root.at);
        root.rising = !root.rising;
        root.slope = root.bend = 0;
        for (int k = base.degree; k >= 1; --k) {
          double const c = rounded(base.c[static_cast<std::size_t>(k)]);
          root.slope = root.slope * root.at + k * c;
          if (k >= 2) root.bend = root.bend * root.at + k * (k - 1) * c;
        }
      }
      if (mirror) {
        root.at = -root.at;
        root.slope = -root.slope;
        root.rising = !root.rising;
      }
      roots.add(root);
    }
    return true;
  };
  bool const good = take(true, true, begin, minus_one) && take(true, false, zero, minus_one)
                    && take(false, false, zero, one) && take(false, true, end, one);
  if (!good) roots.count = before;
  return good;
}

} // namespace

double root_uncertainty(double error, double slope, double bend, double third) {
  if (!(error > 0)) return 0;
  double const triple = std::cbrt(4 * error * error * std::fabs(third));
  double const steep =
      std::max(std::max(std::fabs(slope), std::sqrt(2 * std::fabs(bend) * error)), triple);
  return 2 * error / steep;
}

bool unit_roots(Polynomial<double> const& f, int first, int last, PolynomialRoots& roots) {
  return isolate(f, first, last, roots);
}
bool unit_roots(Polynomial<Twofold> const& f, int first, int last, PolynomialRoots& roots) {
  return isolate(f, first, last, roots);
}
bool line_roots(Polynomial<double> const& f, PolynomialRoots& roots) {
  return whole_line(f, roots);
}
bool line_roots(Polynomial<Twofold> const& f, PolynomialRoots& roots) {
  return whole_line(f, roots);
}

} // namespace abbe::geometry
