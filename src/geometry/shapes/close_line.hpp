// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"
#include "geometry/roots.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace abbe::geometry {

/// A line beside a shape about the origin of object space: moved to its closest approach, and cut
/// to a ball. Places on it are `step` = t - near.t.
struct CloseLine {
  Line<double> line;
  Approach<double> near;
  Vec3 point;     ///< near.point
  Vec3 direction; ///< as given
  double length2 = 0;
  double half = -1; ///< |step| <= half within the ball; negative: it misses

  /// @param radius of the ball; widened by what its users' roundings need
  CloseLine(Ray const& ray, double radius)
      : line(line_of(ray)), direction(ray.direction), length2(glm::dot(direction, direction)) {
    near = approach(line, -glm::dot(ray.origin, direction) / length2);
    point = Vec3(near.point.x, near.point.y, near.point.z);
    double const reach = radius * (1 + gamma_bound(32)) + lane::sum(near.rounding);
    double const distance = std::sqrt(glm::dot(point, point));
    if (distance < reach) {
      half = std::sqrt((reach - distance) * (reach + distance)) / std::sqrt(length2)
             * (1 + gamma_bound(32));
    }
  }

  Vec3 at(double step) const { return point + step * direction; }
  /// Of steps, and of what lies beyond the first crossing ahead: more than crossings' errors.
  double margin() const { return 0x1p-20 * (half + 0x1p-20 * std::fabs(near.t)); }
  /// Of a polynomial along step = from + width s: the roots that crossings_ahead() has to find.
  Wanted ahead(double from, double width) const {
    return {(-near.t - from) / width, std::numeric_limits<double>::infinity(), margin() / width};
  }
  /// The crossing lies ahead, and before all that is beyond `step`.
  bool is_first_before(Crossing const& c, double step) const {
    return c.t > c.error && c.t + c.error < near.t + step - margin();
  }
  /// The place for the line as given, in twice the digits when N has them.
  template <class N>
  std::array<N, 3> place(double step) const {
    N const t = N(near.t) + N(step);
    return {N(line.origin.x) + t * N(direction.x), N(line.origin.y) + t * N(direction.y),
            N(line.origin.z) + t * N(direction.z)};
  }
  /// Bound of the arithmetic error of each component of place().
  template <class N>
  double place_error(double step) const {
    Vec3 const o = glm::abs(Vec3(line.origin.x, line.origin.y, line.origin.z));
    Vec3 const far = o + (std::fabs(near.t) + std::fabs(step)) * glm::abs(direction);
    return 6 * roundoff<N> * std::max(far.x, std::max(far.y, far.z));
  }
  /// Bounds of how far the point of t is off by the roundings of the ray, per component.
  Vec3 moved(double t) const {
    auto const m = line.origin_rounding + std::fabs(t) * line.direction_rounding;
    return {m.x, m.y, m.z};
  }
  Vec3 slack() const { return {line.slack.x, line.slack.y, line.slack.z}; }

  /// The crossing at a root of f, a polynomial in s along step = from + width s.
  /// @param gradient of f in space
  Crossing crossing(double from, double width, PolynomialRoot const& root, Vec3 const& gradient,
                    std::uint32_t face) const {
    double const step = from + width * root.at, t = near.t + step;
    Vec3 const size = glm::abs(gradient);
    Crossing c;
    c.t = t;
    c.error = width * (root.error + root_motion(glm::dot(size, moved(t)), root.slope, root.bend))
              + gamma_bound(4) * (std::fabs(t) + std::fabs(from) + width);
    c.slack = width * root_motion(glm::dot(size, slack()), root.slope, root.bend);
    c.face = face;
    c.entering = !root.rising;
    return c;
  }
  /// The crossing with a plane across an axis at `height`.
  Crossing lid(int axis, double height, std::uint32_t face) const {
    double const speed = direction[axis];
    Crossing c;
    double const step = (height - point[axis]) / speed;
    c.t = near.t + step;
    c.error = (moved(c.t)[axis] + place_error<double>(step)
               + gamma_bound(4) * (std::fabs(height) + std::fabs(point[axis])))
                  / std::fabs(speed)
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step));
    c.slack = slack()[axis] / std::fabs(speed);
    c.face = face;
    return c;
  }
};

} // namespace abbe::geometry
