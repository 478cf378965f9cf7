// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace abbe::optics {

/// A row `[x, y]` of a table.
using Pair = std::array<double, 2>;

/// "" when x increases strictly and all numbers are finite, else what is wrong ("0.5 does not
/// follow 0.6"). A table needs at least one row.
std::string check_table(std::span<Pair const> rows);

/// Linear between the rows; the end values hold outside.
double interpolate_linear(std::span<Pair const> rows, double x);

/// Monotone cubic through a table: no overshoot, continuous slope; the end values hold outside.
/// @source F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238
class MonotoneCubic {
public:
  /// `rows` passes check_table.
  explicit MonotoneCubic(std::vector<Pair> rows);
  double operator()(double x) const;
  std::vector<Pair> const& rows() const { return rows_; }

private:
  std::vector<Pair> rows_;
  std::vector<double> slopes_;
};

} // namespace abbe::optics
