// SPDX-License-Identifier: MIT
#include "optics/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abbe::optics {
namespace {

/// Squares of the lengths of the columns, from row `first` on.
std::vector<double> column_squares(Matrix const& m, std::size_t first) {
  std::vector<double> squares(m.columns());
  for (std::size_t r = first; r < m.rows(); ++r) {
    auto const row = m.row(r);
    for (std::size_t c = 0; c < row.size(); ++c) squares[c] += row[c] * row[c];
  }
  return squares;
}

/// Reflects rows `k` and below so that column `c` is zero below row `k`.
/// @param length of that column from row `k` on, not zero
void reflect(Matrix& m, std::size_t k, std::size_t c, double length) {
  double const head = m.row(k)[c];
  double const new_head = head > 0 ? -length : length;
  std::vector<double> v;
  for (std::size_t r = k; r < m.rows(); ++r) v.push_back(m.row(r)[c]);
  v[0] -= new_head;
  double const scale = 1 / (length * std::abs(v[0])); // 2 / |v|^2
  std::vector<double> shares(m.columns());
  for (std::size_t r = k; r < m.rows(); ++r) add(shares, v[r - k] * scale, m.row(r));
  for (std::size_t r = k; r < m.rows(); ++r) {
    add(m.row(r), -v[r - k], shares);
    m.row(r)[c] = 0;
  }
  m.row(k)[c] = new_head;
}

/// Turns two rows so that they are orthogonal. @return were they not?
bool orthogonalize(std::span<double> a, std::span<double> b) {
  double const aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
  if (std::abs(ab) <= 1e-15 * std::sqrt(aa) * std::sqrt(bb)) return false;
  double const zeta = (bb - aa) / (2 * ab);
  double const size = 1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
  double const tangent = zeta > 0 ? size : -size;
  double const cosine = 1 / std::sqrt(1 + tangent * tangent), sine = cosine * tangent;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double const old = a[i];
    a[i] = cosine * old - sine * b[i];
    b[i] = sine * old + cosine * b[i];
  }
  return true;
}

} // namespace

double dot(std::span<double const> a, std::span<double const> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double length(std::span<double const> a) {
  return std::sqrt(dot(a, a));
}

void add(std::span<double> a, double factor, std::span<double const> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

std::vector<std::size_t> decompose_qr(Matrix& m, std::size_t pivots, double least) {
  std::vector<std::size_t> chosen;
  std::vector<bool> free(pivots, true);
  while (chosen.size() < std::min(m.rows(), pivots)) {
    auto const squares = column_squares(m, chosen.size());
    std::size_t best = pivots;
    for (std::size_t c = 0; c < pivots; ++c)
      if (free[c] && (best == pivots || squares[c] > squares[best])) best = c;
    double const longest = std::sqrt(squares[best]);
    if (!(longest > least)) break;
    reflect(m, chosen.size(), best, longest);
    free[best] = false;
    chosen.push_back(best);
  }
  return chosen;
}

Matrix right_singular_vectors(Matrix m, double least) {
  m.keep_rows(decompose_qr(m, m.columns(), least / 100).size());
  constexpr int max_sweeps = 60; // some ten are usual
  bool turned = true;
  for (int sweep = 0; turned && sweep < max_sweeps; ++sweep) {
    turned = false;
    for (std::size_t a = 0; a < m.rows(); ++a)
      for (std::size_t b = a + 1; b < m.rows(); ++b) turned |= orthogonalize(m.row(a), m.row(b));
  }
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t r = 0; r < m.rows(); ++r)
    if (double const value = length(m.row(r)); value > least) order.emplace_back(-value, r);
  std::sort(order.begin(), order.end());
  Matrix vectors(order.size(), m.columns());
  for (std::size_t i = 0; i < order.size(); ++i)
    add(vectors.row(i), 1 / -order[i].first, m.row(order[i].second));
  return vectors;
}

} // namespace abbe::optics
