// SPDX-License-Identifier: MIT
#include "geometry/shapes/triangle_test.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

ShearedLine::ShearedLine(Line<double> const& line) {
  auto const v = [](lane::Vec<double> const& p) { return Vec3(p.x, p.y, p.z); };
  double const length2 = lane::dot(line.direction, line.direction);
  Approach<double> const near = approach(line, -lane::dot(line.origin, line.direction) / length2);
  point = v(near.point);
  rounding = v(near.rounding);
  t = near.t;
  direction = v(line.direction);
  direction_rounding = v(line.direction_rounding);
  slack = v(line.slack);
  Vec3 const size = glm::abs(direction);
  kz = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  kx = (kz + 1) % 3;
  ky = (kz + 2) % 3;
  sx = direction[kx] / direction[kz];
  sy = direction[ky] / direction[kz];
  sz = 1.0 / direction[kz];
}

namespace {

struct Flat {
  double x, y, depth;
};
Flat flatten(ShearedLine const& line, Vec3 const& vertex) {
  Vec3 const v = vertex - line.point;
  return {v[line.kx] - line.sx * v[line.kz], v[line.ky] - line.sy * v[line.kz],
          line.sz * v[line.kz]};
}

/// a x b as a number, and its exact sign; 0 is broken as if the line were at (epsilon, epsilon^2).
struct Edge {
  double value;
  int sign;
};
Edge edge(Flat const& a, Flat const& b) {
  double const p = a.x * b.y, q = a.y * b.x;
  double value = p - q;
  if (value == 0) {
    value = lane::product_error(a.x, b.y, p) - lane::product_error(a.y, b.x, q);
  }
  double decisive = value;
  if (decisive == 0) decisive = a.y - b.y;
  if (decisive == 0) decisive = b.x - a.x;
  return {value, decisive > 0 ? 1 : (decisive < 0 ? -1 : 0)};
}

} // namespace

std::optional<TriangleHit> hit_triangle(ShearedLine const& line, Vec3 const& a, Vec3 const& b,
                                        Vec3 const& c) {
  Flat const fa = flatten(line, a), fb = flatten(line, b), fc = flatten(line, c);
  Edge const u = edge(fb, fc), v = edge(fc, fa), w = edge(fa, fb);
  if (u.sign == 0 || u.sign != v.sign || u.sign != w.sign) return std::nullopt;
  double const sum = u.value + v.value + w.value;
  auto const [shallow, deep] = std::minmax({fa.depth, fb.depth, fc.depth});
  double step = 0.5 * (shallow + deep);
  if (sum != 0) {
    step = (u.value * fa.depth + v.value * fb.depth + w.value * fc.depth) / sum;
    step = std::clamp(step, shallow, deep);
  }
  Vec3 const normal = glm::cross(b - a, c - a), size = glm::abs(normal);
  double const speed = glm::dot(normal, line.direction);
  // The plane's own rounding is relative to the corners as seen from the line.
  Vec3 const corner = glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c));
  Vec3 const moved = line.rounding + std::fabs(step) * line.direction_rounding
                     + gamma_bound(8) * (corner + glm::abs(line.point));
  double const range = deep - shallow; // the hit is in the triangle, whatever the slope
  TriangleHit hit;
  hit.t = line.t + step;
  hit.error = std::fmin(glm::dot(size, moved) / std::fabs(speed), range)
              + gamma_bound(4) * (std::fabs(hit.t) + std::fabs(step));
  hit.slack = glm::dot(size, line.slack) / std::fabs(speed);
  if (!(hit.slack >= 0)) hit.slack = 0;
  hit.against_normal = speed < 0;
  hit.downward = (u.sign > 0) != (line.direction[line.kz] > 0);
  return hit;
}

Vec3 corner_weights(Vec3 const& point, Vec3 const& a, Vec3 const& b, Vec3 const& c) {
  Vec3 const normal = glm::cross(b - a, c - a);
  double const area2 = glm::dot(normal, normal);
  double const wa = glm::dot(glm::cross(b - point, c - point), normal) / area2;
  double const wb = glm::dot(glm::cross(c - point, a - point), normal) / area2;
  return {wa, wb, 1 - wa - wb};
}

} // namespace abbe::geometry
