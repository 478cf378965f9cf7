// SPDX-License-Identifier: MIT
#include "transport/caustics/beam_map.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

/// Powers of t in Lagrange's polynomials of some nodes: [node][power].
template <std::size_t N>
constexpr std::array<std::array<double, N>, N> lagrange(std::array<double, N> const& nodes) {
  std::array<std::array<double, N>, N> out{};
  for (std::size_t i = 0; i < N; ++i) {
    std::array<double, N> terms{1};
    std::size_t degree = 0;
    for (std::size_t k = 0; k < N; ++k) {
      if (k == i) continue;
      double const scale = 1 / (nodes[i] - nodes[k]);
      ++degree;
      for (std::size_t p = degree + 1; p-- > 0;)
        terms[p] = scale * ((p > 0 ? terms[p - 1] : 0) - nodes[k] * terms[p]);
    }
    out[i] = terms;
  }
  return out;
}

constexpr double root_half = 0.70710678118654752;
constexpr std::array<double, BeamMap::side> side_nodes{-1, -root_half, 0, root_half, 1};
constexpr std::array<double, BeamMap::waves> wave_nodes{-1, -0.75, -0.25, 0.25, 0.75, 1};
constexpr auto side_terms = lagrange(side_nodes);
constexpr auto wave_terms = lagrange(wave_nodes);

} // namespace

Vec2 BeamMap::node(std::size_t k) {
  return {side_nodes[k % side], side_nodes[k / side]};
}

BeamMap::Ray BeamMap::in_frame(Sheet const& sheet, BeamRay const& ray) {
  double const ahead = glm::dot(ray.direction, sheet.along);
  double const sx = glm::dot(ray.direction, sheet.across) / ahead,
               sy = glm::dot(ray.direction, sheet.up) / ahead;
  Vec3 const off = ray.origin - sheet.middle;
  double const begin = glm::dot(off, sheet.along);
  Ray out{};
  out[X] = glm::dot(off, sheet.across) - begin * sx;
  out[Y] = glm::dot(off, sheet.up) - begin * sy;
  out[SlopeX] = sx;
  out[SlopeY] = sy;
  out[Begin] = begin;
  return out;
}

BeamMap::BeamMap(std::span<Ray const> rays) : waves_(rays.size() / terms) {
  terms_.assign(quantities * waves_ * room, 0.0F);
  std::vector<double> sums(rays.size());
  for (std::size_t q = 0; q < quantities; ++q) {
    std::ranges::fill(sums, 0.0);
    for (std::size_t w = 0; w < waves_; ++w) {
      // Along x, then along y, then along the spectrum.
      std::array<double, terms> along_x{}, both{};
      for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t p = 0; p < side; ++p)
          along_x[k / side * side + p] += rays[w * terms + k][q] * side_terms[k % side][p];
      for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t p = 0; p < side; ++p)
          both[p * side + k % side] += along_x[k] * side_terms[k / side][p];
      for (std::size_t p = 0; p < waves_; ++p) {
        double const share = waves_ == 1 ? 1 : wave_terms[w][p];
        for (std::size_t k = 0; k < terms; ++k) sums[p * terms + k] += share * both[k];
      }
    }
    for (std::size_t k = 0; k < rays.size(); ++k)
      terms_[(q * waves_ + k / terms) * room + k % terms] = static_cast<float>(sums[k]);
  }
}

BeamMap::Passing BeamMap::passing(double w, Vec3 const& point) const {
  Passing out;
  auto const ahead = static_cast<float>(point.z), share = static_cast<float>(w);
  auto const collapse = [&](Quantity at, Quantity slope, std::array<float, room>& sum) {
    float const *const a = of(at), *const b = of(slope);
    sum.fill(0);
    for (std::size_t p = waves_; p-- > 0;)
      for (std::size_t k = 0; k < room; ++k)
        sum[k] = sum[k] * share + (a[p * room + k] + ahead * b[p * room + k]);
  };
  collapse(X, SlopeX, out.x);
  collapse(Y, SlopeY, out.y);
  out.x[0] = static_cast<float>(out.x[0] - point.x);
  out.y[0] = static_cast<float>(out.y[0] - point.y);
  return out;
}

BeamMap::Offset BeamMap::offset(Passing const& passing, Vec2 const& u) {
  Offset out{Vec2(0), Vec2(0), Vec2(0)};
  for (int axis = 0; axis < 2; ++axis) {
    auto const& t = axis == 0 ? passing.x : passing.y;
    double value = 0, by_u = 0, by_v = 0;
    for (std::size_t row = side; row-- > 0;) {
      float const* const c = t.data() + row * side;
      double sum = c[4], slope = sum;
      sum = sum * u.x + c[3];
      slope = slope * u.x + sum;
      sum = sum * u.x + c[2];
      slope = slope * u.x + sum;
      sum = sum * u.x + c[1];
      slope = slope * u.x + sum;
      sum = sum * u.x + c[0];
      by_v = by_v * u.y + value;
      value = value * u.y + sum;
      by_u = by_u * u.y + slope;
    }
    out.at[axis] = value;
    out.by_u[axis] = by_u;
    out.by_v[axis] = by_v;
  }
  return out;
}

BeamMap::Ray BeamMap::ray(double w, Vec2 const& u) const {
  std::array<float, room> power{};
  double up = 1;
  for (std::size_t row = 0; row < side; ++row) {
    double along = up;
    for (std::size_t k = 0; k < side; ++k) {
      power[row * side + k] = static_cast<float>(along);
      along *= u.x;
    }
    up *= u.y;
  }
  auto const share = static_cast<float>(w);
  Ray out{};
  for (std::size_t q = 0; q < quantities; ++q) {
    float const* const own = of(q);
    std::array<float, room> sum{};
    for (std::size_t p = waves_; p-- > 0;)
      for (std::size_t k = 0; k < room; ++k) sum[k] = sum[k] * share + own[p * room + k];
    // The first is large and the rest is not: it is added last.
    double rest = 0;
    for (std::size_t k = 1; k < terms; ++k) rest += sum[k] * power[k];
    out[q] = sum[0] + rest;
  }
  return out;
}

} // namespace abbe::transport::caustics
