// SPDX-License-Identifier: MIT
#include "geometry/shapes/convex_prism.hpp"

#include "geometry/shapes/reading.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

double across(Vec2 const& a, Vec2 const& b) {
  return lane::difference_of_products(a.x, b.y, a.y, b.x);
}
/// Edges from which on a line is better compared with the corners (Prism): more than the test of
/// convexity, which asks every pair, is worth.
constexpr std::size_t many_corners = 64;

} // namespace

bool ConvexPrism::is_convex(std::vector<Vec2> const& corners) {
  if (corners.size() < 3 || corners.size() > many_corners) return false;
  bool left = false, right = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vec2 const from = corners[i], along = corners[(i + 1) % corners.size()] - from;
    for (Vec2 const& corner : corners) {
      double const side = across(along, corner - from);
      left = left || side > 0;
      right = right || side < 0;
    }
  }
  return left != right;
}

ConvexPrism::ConvexPrism(std::vector<Vec2> const& corners, bool open)
    : low_(infinity), high_(-infinity), open_(open) {
  for (Vec2 const& corner : corners) {
    low_ = glm::min(low_, corner);
    high_ = glm::max(high_, corner);
  }
  double turning = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vec2 const from = corners[i], along = corners[(i + 1) % corners.size()] - from;
    for (Vec2 const& corner : corners) turning += across(along, corner - from);
  }
  double const sense = turning > 0 ? 1 : -1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vec2 const from = corners[i], to = corners[(i + 1) % corners.size()];
    if (from == to) continue;
    edges_.push_back(
        {from, glm::max(glm::abs(from), glm::abs(to)), sense * Vec2(to.y - from.y, from.x - to.x)});
  }
}

bool ConvexPrism::inside(Vec3 const& point) const {
  return std::fabs(point.y) <= 1 && std::all_of(edges_.begin(), edges_.end(), [&](Edge const& e) {
           return e.outward.x * (e.from.x - point.x) + e.outward.y * (e.from.y - point.z) >= 0;
         });
}

Vec3 ConvexPrism::normal(Vec3 const&, std::uint32_t face) const {
  if (face < 2) return {0, face == 0 ? -1 : 1, 0};
  Vec2 const& outward = edges_[face - 2].outward;
  return unit_vector({outward.x, 0, outward.y});
}

Bounds ConvexPrism::bounds() const {
  return {{low_.x, -1, low_.y}, {high_.x, 1, high_.y}};
}

} // namespace abbe::geometry
