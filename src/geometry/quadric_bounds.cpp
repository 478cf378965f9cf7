// SPDX-License-Identifier: MIT
#include "geometry/quadric_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

struct Range {
  double low = -INFINITY, high = INFINITY;
  bool finite() const { return std::isfinite(low) && std::isfinite(high); }
  double size() const { return std::max(std::fabs(low), std::fabs(high)); }
};
using Ranges = std::array<Range, 3>;

/// More than the roundings of all terms, as a share of what the largest of them may be.
constexpr double slack = 0x1p-40;

/// The product of a coefficient and a range; a coefficient of 0 gives 0.
Range times(double k, Range const& x) {
  if (k == 0) return {0, 0};
  return k > 0 ? Range{k * x.low, k * x.high} : Range{k * x.high, k * x.low};
}

/// The least of square x^2 + linear x.
double least(double square, double linear, Range const& x) {
  auto const at = [&](double v) {
    if (std::isfinite(v)) return (square * v + linear) * v;
    double const grows = square != 0 ? square : linear * (v > 0 ? 1 : -1);
    return grows == 0 ? 0.0 : grows > 0 ? INFINITY : -INFINITY;
  };
  double result = std::min(at(x.low), at(x.high));
  if (square > 0) {
    double const middle = -linear / (2 * square);
    if (middle > x.low && middle < x.high) result = std::min(result, at(middle));
  }
  return result;
}

/// The least of k x y.
double least_product(double k, Range const& x, Range const& y) {
  if (k == 0) return 0;
  if (!x.finite() || !y.finite()) return -INFINITY;
  double const ends[] = {k * x.low * y.low, k * x.low * y.high, k * x.high * y.low,
                         k * x.high * y.high};
  return *std::min_element(std::begin(ends), std::end(ends));
}

/// Number of the coefficient of the product of two axes.
std::size_t product(std::size_t a, std::size_t b) {
  return a + b + 2;
}

/// Narrows the range of an axis to where a quadric can be at most 0.
void narrow(std::array<double, 10> const& k, std::size_t axis, Ranges& x) {
  std::size_t const u = (axis + 1) % 3, v = (axis + 2) % 3;
  auto const sizes = [&](std::size_t at) {
    return x[at].finite() ? std::fabs(k[at]) * x[at].size() * x[at].size()
                                + std::fabs(k[6 + at]) * x[at].size()
                          : 0.0;
  };
  double rest = k[9] + least(k[u], k[6 + u], x[u]) + least(k[v], k[6 + v], x[v])
                + least_product(k[product(u, v)], x[u], x[v]);
  rest -= slack * (std::fabs(k[9]) + std::fabs(rest) + sizes(u) + sizes(v));
  if (!std::isfinite(rest)) return;
  Range const along_u = times(k[product(axis, u)], x[u]),
              along_v = times(k[product(axis, v)], x[v]);
  double const linear = k[6 + axis];
  double const off = slack
                     * (std::fabs(linear) + (along_u.finite() ? along_u.size() : 0)
                        + (along_v.finite() ? along_v.size() : 0));
  Range const b{linear + along_u.low + along_v.low - off,
                linear + along_u.high + along_v.high + off};
  double const a = k[axis];
  if (!b.finite() || a < 0) return;
  Range found;
  if (a > 0) {
    // A positive rest leaves less than 0 does, so that 0 is taken for it.
    double const room = -4 * a * std::min(rest, 0.0);
    found = {(-b.high - std::sqrt(b.high * b.high + room)) / (2 * a),
             (-b.low + std::sqrt(b.low * b.low + room)) / (2 * a)};
  } else if (b.low > 0) {
    found.high = std::max(-rest / b.low, -rest / b.high);
  } else if (b.high < 0) {
    found.low = std::min(-rest / b.low, -rest / b.high);
  }
  double const wide = slack
                      * ((std::isfinite(found.low) ? std::fabs(found.low) : 0)
                         + (std::isfinite(found.high) ? std::fabs(found.high) : 0));
  x[axis].low = std::max(x[axis].low, found.low - wide);
  x[axis].high = std::min(x[axis].high, found.high + wide);
}

} // namespace

WorldQuadric WorldQuadric::of(Placed const& placed, std::array<double, 10> const& k) {
  Vec3 row[3];
  for (int i = 0; i < 3; ++i) {
    Vec3 unit(0);
    unit[i] = 1;
    row[i] = placed.to_world_normal(unit);
  }
  // Half of the matrix of squares and products, row by row.
  double const half[3][3] = {
      {k[0], k[3] / 2, k[4] / 2}, {k[3] / 2, k[1], k[5] / 2}, {k[4] / 2, k[5] / 2, k[2]}};
  WorldQuadric out{placed.offset(), {}};
  auto const square = [&](int a, int b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += half[i][j] * row[i][a] * row[j][b];
    return sum;
  };
  for (int a = 0; a < 3; ++a) out.k[static_cast<std::size_t>(a)] = square(a, a);
  out.k[3] = 2 * square(0, 1);
  out.k[4] = 2 * square(0, 2);
  out.k[5] = 2 * square(1, 2);
  for (int a = 0; a < 3; ++a)
    out.k[static_cast<std::size_t>(6 + a)] = k[6] * row[0][a] + k[7] * row[1][a] + k[8] * row[2][a];
  out.k[9] = k[9];
  return out;
}

Bounds bounds_of(std::vector<HalfSpace> const& spaces, std::vector<WorldQuadric> const& quadrics) {
  if (quadrics.empty()) return all_space();
  Ranges box;
  for (HalfSpace const& space : spaces)
    for (int axis = 0; axis < 3; ++axis) {
      double const along = space.normal[axis];
      if (space.normal != along * Vec3(axis == 0, axis == 1, axis == 2) || along == 0) continue;
      double const end = space.most / along, wide = slack * std::fabs(end);
      Range& range = box[static_cast<std::size_t>(axis)];
      if (along > 0)
        range.high = std::min(range.high, end + wide);
      else
        range.low = std::max(range.low, end - wide);
    }
  // Each axis may wait for the others; more than this gains little.
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round)
    for (WorldQuadric const& quadric : quadrics)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Ranges here = box;
        for (std::size_t i = 0; i < 3; ++i) {
          double const at = quadric.origin[static_cast<int>(i)];
          double const wide = slack * std::fabs(at);
          here[i] = {box[i].low - at - wide, box[i].high - at + wide};
        }
        narrow(quadric.k, axis, here);
        double const at = quadric.origin[static_cast<int>(axis)], wide = slack * std::fabs(at);
        box[axis].low = std::max(box[axis].low, here[axis].low + at - wide);
        box[axis].high = std::min(box[axis].high, here[axis].high + at + wide);
      }
  if (!box[0].finite() || !box[1].finite() || !box[2].finite()) return all_space();
  Vec3 const low(box[0].low, box[1].low, box[2].low), high(box[0].high, box[1].high, box[2].high);
  return low.x > high.x || low.y > high.y || low.z > high.z ? Bounds{} : box_of(low, high);
}

} // namespace abbe::geometry
