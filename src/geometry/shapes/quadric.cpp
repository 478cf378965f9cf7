// SPDX-License-Identifier: MIT
#include "geometry/shapes/quadric.hpp"

#include "geometry/bounds.hpp"

#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// An ellipsoid along the axes has bounds; all else is taken as infinite.
Bounds quadric_bounds(std::array<double, 10> const& k) {
  Bounds bounds;
  bounds.infinite = true;
  bool const along_axes = k[3] == 0 && k[4] == 0 && k[5] == 0;
  if (!along_axes || !(k[0] > 0 && k[1] > 0 && k[2] > 0)) return bounds;
  Vec3 const square(k[0], k[1], k[2]), linear(k[6], k[7], k[8]);
  Vec3 const centre = -linear / (2.0 * square);
  Vec3 const parts = linear * linear / (4.0 * square);
  double const size = parts.x + parts.y + parts.z - k[9];
  double const rounding = gamma_bound(16) * (parts.x + parts.y + parts.z + std::fabs(k[9]));
  if (size + rounding < 0) return {}; // nowhere negative
  Vec3 const half = glm::sqrt((size + rounding) / square);
  Vec3 const wide = half + gamma_bound(16) * (half + glm::abs(centre));
  return box_of(centre - wide, centre + wide);
}

} // namespace

Quadric::Quadric(std::array<double, 10> const& coefficients)
    : k_(coefficients),
      bounds_(quadric_bounds(coefficients)),
      convex_(k_[0] >= 0 && k_[1] >= 0 && k_[2] >= 0 && k_[3] == 0 && k_[4] == 0 && k_[5] == 0) {}

/// Along each axis on which a cylinder or paraboloid ends, whatever the others are.
void Quadric::half_spaces(std::vector<HalfSpace>& out) const {
  if (k_[3] != 0 || k_[4] != 0 || k_[5] != 0) return;
  for (std::size_t i = 0; i < 3; ++i) {
    double rest = k_[9], size = std::fabs(k_[9]); // the least of all that the other axes add
    bool ends = k_[i] > 0;
    for (std::size_t other = 0; other < 3; ++other) {
      if (other == i) continue;
      double const square = k_[other], linear = k_[6 + other];
      ends = ends && (square > 0 || (square == 0 && linear == 0));
      if (!(square > 0)) continue;
      double const part = linear * linear / (4 * square);
      rest -= part;
      size += part;
    }
    double const half_linear = 0.5 * k_[6 + i];
    double const room = half_linear * half_linear - k_[i] * (rest - gamma_bound(16) * size);
    if (!ends || !(room >= 0)) continue;
    double const middle = -half_linear / k_[i], half = std::sqrt(room) / k_[i];
    double const wide = half + gamma_bound(16) * (half + std::fabs(middle));
    if (!std::isfinite(middle + wide) || !std::isfinite(wide - middle)) continue;
    Vec3 axis(0);
    axis[static_cast<int>(i)] = 1;
    out.push_back({axis, middle + wide});
    out.push_back({-axis, wide - middle});
  }
}

double Quadric::value(Vec3 const& p) const {
  return k_[0] * (p.x * p.x) + k_[1] * (p.y * p.y) + k_[2] * (p.z * p.z) + k_[3] * (p.x * p.y)
         + k_[4] * (p.x * p.z) + k_[5] * (p.y * p.z) + (k_[6] * p.x + k_[7] * p.y + k_[8] * p.z)
         + k_[9];
}

void Quadric::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  if (convex_) return ConvexShape::crossings(ray, start, out);
  double k[10];
  std::copy(k_.begin(), k_.end(), k);
  kernels::QuadricRoots<double> const roots = kernels::quadric(line_of(ray), k);
  std::size_t const first = out.size();
  auto const push = [&](Root<double> const& root, bool entering) {
    if (!std::isfinite(root.t)) return;
    out.push_back({root.t, root.error, root.slack, 0, entering, true, true});
  };
  if (roots.exists != 0) {
    push(roots.low, roots.leading == 0 ? roots.slope < 0 : roots.leading > 0);
    if (roots.leading != 0) push(roots.high, roots.leading < 0);
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

Vec3 Quadric::normal(Vec3 const& p, std::uint32_t) const {
  Vec3 const slope(2 * (k_[0] * p.x) + k_[3] * p.y + k_[4] * p.z + k_[6],
                   2 * (k_[1] * p.y) + k_[3] * p.x + k_[5] * p.z + k_[7],
                   2 * (k_[2] * p.z) + k_[4] * p.x + k_[5] * p.y + k_[8]);
  if (slope == Vec3(0) || !finite(slope)) return {0, 1, 0}; // the tip of a cone has none
  return unit_vector(slope);
}

std::optional<PlacedShape> make_quadric(std::array<double, 10> const& k) {
  bool const all_finite =
      std::all_of(k.begin(), k.end(), [](double c) { return std::isfinite(c); });
  bool const varies = std::any_of(k.begin(), k.end() - 1, [](double c) { return c != 0; });
  if (!all_finite || !varies) return std::nullopt;
  return PlacedShape{std::make_shared<Quadric>(k), {}};
}

std::optional<PlacedShape> read_quadric(Parameters& parameters) {
  Vec3 const a = parameters.vec3("squares A, B, C");
  Vec3 const d = parameters.vec3("products D, E, F");
  Vec3 const g = parameters.vec3("linear terms G, H, I");
  double const j = parameters.number("constant J");
  if (a == Vec3(0) && d == Vec3(0) && g == Vec3(0))
    return left_out(parameters, "E0607", "a quadric of a constant alone is not drawn");
  return or_report(make_quadric({a.x, a.y, a.z, d.x, d.y, d.z, g.x, g.y, g.z, j}), parameters,
                   "E0607", "a quadric needs finite coefficients");
}

} // namespace abbe::geometry
