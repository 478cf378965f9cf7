// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace abbe::geometry {

/// How points become a curve of cubic pieces.
enum class SplineKind { Linear, Quadratic, Cubic, Bezier, BSpline };

/// How a scene names a kind, and how many points it needs.
struct SplineWord {
  char const* word;
  SplineKind kind;
  int least_points;
};
/// The one of the words that is next, which is taken; null when none is.
template <std::size_t N>
SplineWord const* accept_spline(Parameters& parameters, SplineWord const (&words)[N]) {
  for (SplineWord const& candidate : words)
    if (parameters.accept(candidate.word)) return &candidate;
  return nullptr;
}

/// c0 + c1 u + c2 u^2 + c3 u^3 for u in [0, 1]; neighbours have the same bits at their joint.
template <std::size_t D>
struct CurvePiece {
  using Point = std::array<double, D>;
  std::array<Point, 4> c;
  Point begin, end;
  int degree = 3; ///< of all coordinates

  /// The curve's coordinate k as a polynomial. @pre degree <= Degree
  template <class N, int Degree>
  Terms<N, Degree> terms(std::size_t k) const {
    Terms<N, Degree> f;
    for (std::size_t i = 0; i <= Degree; ++i) f.c[i] = N(c[i][k]);
    return f;
  }
  /// work(degree as a constant, 1 to 3)
  template <class Work>
  auto with_degree(Work const& work) const {
    if (degree == 1) return work(std::integral_constant<int, 1>());
    if (degree == 2) return work(std::integral_constant<int, 2>());
    return work(std::integral_constant<int, 3>());
  }
  double at(std::size_t k, double u) const {
    return ((c[3][k] * u + c[2][k]) * u + c[1][k]) * u + c[0][k];
  }
  double slope(std::size_t k, double u) const {
    return (3 * c[3][k] * u + 2 * c[2][k]) * u + c[1][k];
  }
  /// Its Bernstein coefficients, between the least and largest of which it stays.
  std::array<double, 4> corners(std::size_t k) const {
    return {c[0][k], c[0][k] + c[1][k] / 3, c[0][k] + (2 * c[1][k] + c[2][k]) / 3, end[k]};
  }
};

/// The pieces that POV-Ray makes of the points (language notes, 20.2). Linear: all of them.
/// Quadratic: from the second on, its tangent at each point parallel to the chord of the
/// neighbours. Cubic: Catmull-Rom, without the first and last. Bezier: four points a piece, no
/// point shared. BSpline: uniform cubic.
/// @return empty when there are too few points (or, Bezier, no multiple of four)
template <std::size_t D>
std::vector<CurvePiece<D>> spline_pieces(SplineKind kind,
                                         std::vector<std::array<double, D>> const& p) {
  using Piece = CurvePiece<D>;
  std::size_t const n = p.size();
  std::vector<Piece> pieces;
  auto const add = [&](auto const& coefficients, auto const& begin, auto const& end) {
    Piece piece{};
    for (std::size_t k = 0; k < D; ++k) {
      std::array<double, 4> const c = coefficients(k);
      for (std::size_t i = 0; i < 4; ++i) piece.c[i][k] = c[i];
      piece.begin[k] = begin(k);
      piece.end[k] = end(k);
    }
    auto const none = [&](std::size_t power) {
      return std::all_of(piece.c[power].begin(), piece.c[power].end(),
                         [](double c) { return c == 0; });
    };
    while (piece.degree > 1 && none(static_cast<std::size_t>(piece.degree))) --piece.degree;
    pieces.push_back(piece);
  };
  auto const point = [&](std::size_t i) { return [&p, i](std::size_t k) { return p[i][k]; }; };
  using Four = std::array<double, 4>;
  switch (kind) {
  case SplineKind::Linear:
    for (std::size_t i = 0; i + 1 < n; ++i)
      add(
          [&](std::size_t k) {
            return Four{p[i][k], p[i + 1][k] - p[i][k], 0, 0};
          },
          point(i), point(i + 1));
    break;
  case SplineKind::Quadratic:
    for (std::size_t i = 0; i + 2 < n; ++i)
      add(
          [&](std::size_t k) {
            double const tangent = (p[i + 2][k] - p[i][k]) / 2;
            return Four{p[i + 1][k], tangent, p[i + 2][k] - p[i + 1][k] - tangent, 0};
          },
          point(i + 1), point(i + 2));
    break;
  case SplineKind::Cubic:
    for (std::size_t i = 0; i + 3 < n; ++i)
      add(
          [&](std::size_t k) {
            double const a = (p[i + 2][k] - p[i][k]) / 2, b = (p[i + 3][k] - p[i + 1][k]) / 2;
            double const rise = p[i + 2][k] - p[i + 1][k];
            return Four{p[i + 1][k], a, 3 * rise - 2 * a - b, a + b - 2 * rise};
          },
          point(i + 1), point(i + 2));
    break;
  case SplineKind::Bezier:
    if (n % 4 != 0) return pieces;
    for (std::size_t i = 0; i < n; i += 4)
      add(
          [&](std::size_t k) {
            double const a = p[i][k], b = p[i + 1][k], c = p[i + 2][k], d = p[i + 3][k];
            return Four{a, 3 * (b - a), 3 * (a - 2 * b + c), d - a + 3 * (b - c)};
          },
          point(i), point(i + 3));
    break;
  case SplineKind::BSpline:
    for (std::size_t i = 0; i + 3 < n; ++i) {
      auto const joint = [&](std::size_t j) {
        return [&p, j](std::size_t k) { return (p[j][k] + 4 * p[j + 1][k] + p[j + 2][k]) / 6; };
      };
      add(
          [&](std::size_t k) {
            double const a = p[i][k], b = p[i + 1][k], c = p[i + 2][k], d = p[i + 3][k];
            return Four{(a + 4 * b + c) / 6, (c - a) / 2, (a - 2 * b + c) / 2,
                        (d - a + 3 * (b - c)) / 6};
          },
          joint(i), joint(i + 1));
    }
    break;
  }
  return pieces;
}

/// A point of a piece in a plane.
struct NearestPoint {
  double at = 0;                                         ///< on the piece, 0 to 1
  double miss = std::numeric_limits<double>::infinity(); ///< its distance, squared
};
/// The point that is nearest to (x, y), of the piece's first two coordinates: an end, or where the
/// piece is at right angles to the way there.
template <class Piece>
NearestPoint nearest_of(Piece const& piece, double x, double y) {
  NearestPoint best;
  auto const take = [&](double u) {
    double const a = piece.at(0, u) - x, b = piece.at(1, u) - y, miss = a * a + b * b;
    if (miss < best.miss) best = {u, miss};
  };
  take(0);
  take(1);
  PolynomialRoots roots;
  piece.with_degree([&](auto degree) {
    unit_roots_of(
        [&]<class N>(N) {
          auto const px = piece.template terms<N, degree()>(0);
          auto const py = piece.template terms<N, degree()>(1);
          return sum_of(product(sum_of(px, constant(N(-x))), derivative_of(px)),
                        product(sum_of(py, constant(N(-y))), derivative_of(py)));
        },
        roots);
  });
  for (PolynomialRoot const& root : roots) take(root.at);
  return best;
}

} // namespace abbe::geometry
