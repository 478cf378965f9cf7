// SPDX-License-Identifier: MIT
#include "geometry/bvh_space.hpp"

#include "geometry/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::geometry {

namespace {

double largest(Vec3 const& v) {
  return std::max(v.x, std::max(v.y, v.z));
}

} // namespace

BvhBox BvhSpace::box(Vec3 const& low, Vec3 const& high, std::uint32_t item) const {
  BvhBox out;
  auto const outwards = [](double x) {
    return static_cast<float>(x - std::max(std::fabs(x) * 0x1p-23, 0x1p-120));
  };
  for (int axis = 0; axis < 3; ++axis) {
    out.side[axis] = outwards((low[axis] - centre[axis]) * per_unit);
    out.side[axis + 3] = outwards((centre[axis] - high[axis]) * per_unit);
  }
  out.item = item;
  return out;
}

void BvhSpaceFinder::add(Vec3 const& low, Vec3 const& high) {
  hull_ = geometry::hull(hull_, {low, high, false});
  double const share = 1 / largest(high - low);
  sum_ += share * (low * 0.5 + high * 0.5);
  weight_ += share;
}

BvhSpace BvhSpaceFinder::space() const {
  BvhSpace out;
  if (hull_.empty()) return out;
  Vec3 const middle = hull_.low * 0.5 + hull_.high * 0.5, half = hull_.high * 0.5 - hull_.low * 0.5;
  // Boxes without a size, or of sizes whose inverse is no number: the middle of all.
  out.centre = glm::clamp(sum_ / weight_, hull_.low, hull_.high);
  double const sum = out.centre.x + out.centre.y + out.centre.z;
  double farthest = largest(glm::max(hull_.high - out.centre, out.centre - hull_.low));
  if (!(std::fabs(sum) < std::numeric_limits<double>::infinity())
      || !(farthest < std::numeric_limits<double>::infinity())) {
    out.centre = middle;
    farthest = largest(half);
  }
  if (farthest > 0) {
    out.unit = std::exp2(std::clamp(std::ilogb(farthest), -1000, 1000));
    out.per_unit = 1 / out.unit;
  }
  return out;
}

} // namespace abbe::geometry
