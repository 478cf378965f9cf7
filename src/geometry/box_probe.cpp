// SPDX-License-Identifier: MIT
#include "geometry/box_probe.hpp"

#include <bit>
#include <cstdint>

namespace abbe::geometry {

namespace {

/// The power of two that takes the largest component to [1, 2); 0: there is none.
double inverse_size(Vec3 const& v) {
  double const largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  std::uint64_t const exponent = std::bit_cast<std::uint64_t>(largest) >> 52;
  if (exponent < 1 || exponent > 2045) return 0;
  return std::bit_cast<double>((2046 - exponent) << 52);
}

/// Components below this share of the largest move a line by what is added to its place instead.
constexpr double least_component = 0x1p-100;

} // namespace

NodeProbe::NodeProbe(Ray const& ray, BvhSpace const& space, Vec3 const& reach) {
  double const scale = inverse_size(ray.direction);
  per_t_ = space.per_unit / scale;
  Vec3 const at = (ray.origin - space.centre) * space.per_unit, way = ray.direction * scale;
  start_ = -glm::dot(at, way) / glm::dot(way, way);
  Vec3 const step = start_ * way, place = at + step;
  Vec3 const off = (glm::abs(at) + glm::abs(step)) * (8 * unit_roundoff) + glm::abs(place) * 0x1p-22
                   + reach * (space.per_unit * (1 + 0x1p-20));
  double const far =
      std::fabs(start_) + std::fabs(place.x) + std::fabs(place.y) + std::fabs(place.z) + 16;
  bool const usable = per_t_ > 0x1p-1000 && per_t_ < 0x1p1000 && far < 0x1p100;
  if (!usable) {
    per_t_ = 0;
    start_ = std::numeric_limits<double>::quiet_NaN();
  }
  for (int i = 0; i < 3; ++i) {
    Axis& axis = axes_[i];
    bool const still = std::fabs(way[i]) < least_component;
    double const room = off[i] + (still ? std::fabs(way[i]) * far : 0.0);
    axis.inverse = still ? std::numeric_limits<float>::infinity() : static_cast<float>(1 / way[i]);
    bool const falling = axis.inverse < 0;
    axis.near = static_cast<float>(falling ? place[i] - room : place[i] + room);
    axis.far = static_cast<float>(falling ? place[i] + room : place[i] - room);
    axis.sides = BoxSides(static_cast<std::size_t>(i), falling);
    if (!usable) axis.inverse = std::numeric_limits<float>::quiet_NaN();
  }
}

} // namespace abbe::geometry
