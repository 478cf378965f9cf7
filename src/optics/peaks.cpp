// SPDX-License-Identifier: MIT
#include "optics/peaks.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

constexpr double steps_of_a_line = 2;
constexpr double least_share = 1.0 / 200;

double energy_of(std::vector<Pair> const& rows) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    sum += 0.5 * (rows[i][1] + rows[i + 1][1]) * (rows[i + 1][0] - rows[i][0]);
  return sum;
}

/// Integral and first moment of a function that is linear between the rows.
Pair energy_and_centre(std::vector<Pair> const& rows) {
  double const from = rows.front()[0];
  double energy = 0, moment = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    double const h = rows[i + 1][0] - rows[i][0], x = rows[i][0] - from;
    double const a = rows[i][1], b = rows[i + 1][1];
    energy += 0.5 * h * (a + b);
    moment += 0.5 * h * (a + b) * x + h * h * (a + 2 * b) / 6;
  }
  return {energy, from + moment / energy};
}

/// Width where a function that is linear between the rows is above half of its largest value.
double width_at_half(std::vector<Pair> const& rows) {
  double most = 0;
  for (Pair const& row : rows) most = std::max(most, row[1]);
  double const half = 0.5 * most;
  double width = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    double const h = rows[i + 1][0] - rows[i][0];
    double const low = std::min(rows[i][1], rows[i + 1][1]);
    double const high = std::max(rows[i][1], rows[i + 1][1]);
    if (low >= half)
      width += h;
    else if (high > half)
      width += h * (high - half) / (high - low);
  }
  return width;
}

/// A row above both neighbours, and where it ends.
struct Peak {
  std::size_t row, left, right; ///< the ends may not be rows: then the next ones inside
  double left_nm, right_nm;
};

Peak peak_at(std::vector<Pair> const& rows, std::size_t row, double reach_nm) {
  Peak peak{row, row, row, rows[row][0] - reach_nm, rows[row][0] + reach_nm};
  // A line midway between two rows makes two alike.
  if (rows[row + 1][1] == rows[row][1]) ++peak.right;
  while (peak.left > 0 && rows[peak.left - 1][1] < rows[peak.left][1]
         && rows[peak.left - 1][0] >= peak.left_nm)
    --peak.left;
  while (peak.right + 1 < rows.size() && rows[peak.right + 1][1] < rows[peak.right][1]
         && rows[peak.right + 1][0] <= peak.right_nm)
    ++peak.right;
  // It rises again, or there is nothing more: the end is this row.
  if (peak.left == 0 || rows[peak.left - 1][1] >= rows[peak.left][1])
    peak.left_nm = rows[peak.left][0];
  if (peak.right + 1 == rows.size() || rows[peak.right + 1][1] >= rows[peak.right][1])
    peak.right_nm = rows[peak.right][0];
  return peak;
}

} // namespace

SplitTable split_peaks(std::vector<Pair> const& rows, Bands const& bands) {
  SplitTable out;
  double const least = least_share * energy_of(rows);
  std::size_t kept = 0; // rows before this one are in `smooth`, or were taken off
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    double const nm = rows[i][0];
    if (!(rows[i][1] > rows[i - 1][1] && rows[i][1] >= rows[i + 1][1]) || !bands.contains(nm))
      continue;
    double const band_nm = bands.width(bands.index_of(nm));
    Peak const peak = peak_at(rows, i, 2 * band_nm);
    if (!out.smooth.empty() && peak.left_nm < out.smooth.back()[0]) continue;
    double const left = interpolate_linear(rows, peak.left_nm);
    double const right = interpolate_linear(rows, peak.right_nm);
    std::vector<Pair> base{{peak.left_nm, left}}, above{{peak.left_nm, 0}};
    double base_at_peak = 0;
    for (std::size_t k = peak.left; k <= peak.right; ++k) {
      if (rows[k][0] <= peak.left_nm || rows[k][0] >= peak.right_nm) continue;
      double const t = (rows[k][0] - peak.left_nm) / (peak.right_nm - peak.left_nm);
      double const line = std::min(rows[k][1], left + t * (right - left));
      if (k == i) base_at_peak = line;
      base.push_back({rows[k][0], line});
      above.push_back({rows[k][0], rows[k][1] - line});
    }
    base.push_back({peak.right_nm, right});
    above.push_back({peak.right_nm, 0});
    double const step_nm = 0.5 * (rows[i + 1][0] - rows[i - 1][0]);
    double const width_nm = width_at_half(above);
    Pair const energy = energy_and_centre(above);
    // Rounding of sums of some ten terms; a triangle of two rows is one step wide.
    if (width_nm > std::min(band_nm, steps_of_a_line * step_nm) * (1 + 1e-12)
        || rows[i][1] < 2 * base_at_peak || energy[0] < least || !bands.contains(energy[1]))
      continue;
    for (; kept < rows.size() && rows[kept][0] < peak.left_nm; ++kept)
      out.smooth.push_back(rows[kept]);
    if (!out.smooth.empty() && out.smooth.back()[0] == base.front()[0]) out.smooth.pop_back();
    out.smooth.insert(out.smooth.end(), base.begin(), base.end());
    while (kept < rows.size() && rows[kept][0] <= peak.right_nm) ++kept;
    out.lines.push_back({energy[1], energy[0]});
  }
  for (; kept < rows.size(); ++kept) out.smooth.push_back(rows[kept]);
  return out;
}

} // namespace abbe::optics
