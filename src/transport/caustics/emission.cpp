// SPDX-License-Identifier: MIT
#include "transport/caustics/emission.hpp"

#include "simd/math.hpp"
#include "transport/caustics/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace abbe::transport::caustics {
namespace {

/// Not of unit length.
Vec3 on_cube(int face, Vec2 const& u) {
  double const side = face % 2 == 0 ? 1 : -1;
  switch (face / 2) {
  case 0:
    return {side, u.x, u.y};
  case 1:
    return {u.y, side, u.x};
  default:
    return {u.x, u.y, side};
  }
}

} // namespace

Emission::Emission(LampRays const& lamp, geometry::Bounds const& casters) : lamp_(lamp) {
  if (!lamp.parallel) return;
  Vec3 const d = lamp.direction;
  std::tie(across_, up_) = axes_across(d);
  Vec3 const middle = 0.5 * (casters.low + casters.high);
  half_ = 0.5 * glm::length(casters.high - casters.low) * (1 + 1.0 / 1024);
  centre_ = middle - glm::dot(middle - lamp.position, d) * d;
}

Vec3 Emission::origin(Place const& at) const {
  if (!lamp_.parallel) return lamp_.position;
  return centre_ + half_ * (at.u.x * across_ + at.u.y * up_);
}

Vec3 Emission::direction(Place const& at) const {
  if (lamp_.parallel) return lamp_.direction;
  Vec3 const d = on_cube(at.face, at.u);
  return d / std::sqrt(glm::dot(d, d));
}

Vec3 Emission::name(Place const& at) const {
  return lamp_.parallel ? Vec3(at.u.x, at.u.y, 0) : direction(at);
}

double Emission::density(Place const& at) const {
  if (lamp_.parallel) return half_ * half_;
  double const square = 1 + glm::dot(at.u, at.u);
  return 1 / (square * std::sqrt(square));
}

bool Emission::may_meet(int face, Vec2 const& low, Vec2 const& high, Ball const& ball) const {
  if (lamp_.parallel) {
    Vec3 const from = ball.centre - centre_;
    Vec2 const at{glm::dot(from, across_), glm::dot(from, up_)};
    Vec2 const near{std::clamp(at.x, half_ * low.x, half_ * high.x),
                    std::clamp(at.y, half_ * low.y, half_ * high.y)};
    return glm::length(at - near) <= ball.radius * (1 + 1e-9);
  }
  Vec3 const way = ball.centre - lamp_.position;
  double const distance = glm::length(way);
  if (distance <= ball.radius * (1 + 1e-9)) return true;
  Vec3 const middle = glm::normalize(on_cube(face, 0.5 * (low + high)));
  double widest = 1;
  for (double const x : {low.x, high.x})
    for (double const y : {low.y, high.y})
      widest = std::min(widest, glm::dot(middle, glm::normalize(on_cube(face, {x, y}))));
  auto const angle_of = [](double cosine) { return simd::acos(std::clamp(cosine, -1.0, 1.0)); };
  double const seen = std::numbers::pi / 2 - angle_of(ball.radius / distance);
  return angle_of(glm::dot(middle, way) / distance)
         <= (seen + angle_of(widest)) * (1 + 1e-9) + 1e-12;
}

} // namespace abbe::transport::caustics
