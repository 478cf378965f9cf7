// SPDX-License-Identifier: MIT
#include "study/front.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::study {

std::vector<bool> pareto_front(std::span<Point const> points) {
  std::vector<bool> front(points.size(), true);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (auto const& other : points) {
      Point const& here = points[i];
      bool const no_worse = other.cost <= here.cost && other.error <= here.error;
      bool const better = other.cost < here.cost || other.error < here.error;
      if (no_worse && better) front[i] = false;
    }
  return front;
}

std::optional<double> cost_at_error(std::span<Point const> points, double error) {
  std::vector<Point> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](Point const& a, Point const& b) { return a.cost < b.cost; });
  Point const* before = nullptr;
  for (auto const& point : sorted) {
    if (point.error <= error) {
      if (!before || point.error <= 0 || point.cost <= 0) return point.cost;
      double const share = std::log(before->error / error) / std::log(before->error / point.error);
      return before->cost * std::pow(point.cost / before->cost, share);
    }
    if (!before || point.error < before->error) before = &point;
  }
  return std::nullopt;
}

} // namespace abbe::study
