// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace abbe::study {

/// What a setting costs and how wrong it is, both > 0 in the sense of logarithms; 0 is possible.
struct Point {
  double cost = 0, error = 0;
};

/// Which points no other beats: none is at most as dear and at most as wrong, and better in one.
std::vector<bool> pareto_front(std::span<Point const> points);

/// What it costs to be no more wrong than `error`, by the points of one family: straight lines
/// between them where both axes are logarithmic. Nothing when the error is not reached; the cost of
/// the cheapest point when that is good enough.
std::optional<double> cost_at_error(std::span<Point const> points, double error);

} // namespace abbe::study
