// SPDX-License-Identifier: MIT
#include "optics/interpolate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

/// Index i with rows[i].x <= x < rows[i+1].x for x strictly inside the table.
std::size_t find_cell(std::span<Pair const> rows, double x) {
  auto const upper = std::upper_bound(rows.begin(), rows.end(), x,
                                      [](double v, Pair const& row) { return v < row[0]; });
  return static_cast<std::size_t>(upper - rows.begin()) - 1;
}

} // namespace

std::string check_table(std::span<Pair const> rows) {
  if (rows.empty()) return "the table is empty";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(rows[i][0]) || !std::isfinite(rows[i][1]))
      return "the table holds a non-finite number";
    if (i > 0 && !(rows[i - 1][0] < rows[i][0]))
      return fmt::format("wavelengths must increase: {} does not follow {}", rows[i][0],
                         rows[i - 1][0]);
  }
  return {};
}

double interpolate_linear(std::span<Pair const> rows, double x) {
  if (x <= rows.front()[0]) return rows.front()[1];
  if (x >= rows.back()[0]) return rows.back()[1];
  std::size_t const i = find_cell(rows, x);
  double const t = (x - rows[i][0]) / (rows[i + 1][0] - rows[i][0]);
  return rows[i][1] + (rows[i + 1][1] - rows[i][1]) * t;
}

MonotoneCubic::MonotoneCubic(std::vector<Pair> rows)
    : rows_(std::move(rows)), slopes_(rows_.size(), 0.0) {
  std::size_t const n = rows_.size();
  if (n < 2) return;
  std::vector<double> chord(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i)
    chord[i] = (rows_[i + 1][1] - rows_[i][1]) / (rows_[i + 1][0] - rows_[i][0]);
  slopes_[0] = chord[0];
  slopes_[n - 1] = chord[n - 2];
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double const left = rows_[i][0] - rows_[i - 1][0];
    double const right = rows_[i + 1][0] - rows_[i][0];
    // Slope of the parabola through three rows; none at a turning point.
    if (chord[i - 1] * chord[i] > 0)
      slopes_[i] = (right * chord[i - 1] + left * chord[i]) / (left + right);
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (chord[i] == 0) {
      slopes_[i] = slopes_[i + 1] = 0;
      continue;
    }
    double const a = slopes_[i] / chord[i];
    double const b = slopes_[i + 1] / chord[i];
    double const r = std::sqrt(a * a + b * b);
    if (r > 3) {
      slopes_[i] *= 3 / r;
      slopes_[i + 1] *= 3 / r;
    }
  }
}

double MonotoneCubic::operator()(double x) const {
  if (x <= rows_.front()[0]) return rows_.front()[1];
  if (x >= rows_.back()[0]) return rows_.back()[1];
  std::size_t const i = find_cell(rows_, x);
  double const h = rows_[i + 1][0] - rows_[i][0];
  double const t = (x - rows_[i][0]) / h;
  double const s = 1 - t;
  double const y0 = rows_[i][1];
  double const rise = rows_[i + 1][1] - y0;
  return y0 + rise * (t * t * (1 + 2 * s)) + h * t * s * (slopes_[i] * s - slopes_[i + 1] * t);
}

} // namespace abbe::optics
