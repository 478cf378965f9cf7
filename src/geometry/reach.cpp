// SPDX-License-Identifier: MIT
#include "geometry/reach.hpp"

#include "geometry/half_spaces.hpp"
#include "geometry/placed.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// Squares of sizes within these neither overflow nor lose digits.
constexpr double smallest = 0x1p-400, largest = 0x1p400;

double square(Vec3 const& v) {
  return glm::dot(v, v);
}
double sum_of_sizes(Vec3 const& v) {
  return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
}
Mat3 sizes(Mat3 const& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

/// Half of the longest diagonal of the box that `half` becomes.
double half_diagonal(Mat3 const& m, Vec3 const& half) {
  double longest = 0;
  for (int i = 0; i < 4; ++i) {
    Vec3 const corner(half.x, (i & 1) != 0 ? -half.y : half.y, (i & 2) != 0 ? -half.z : half.z);
    longest = std::max(longest, square(m * corner));
  }
  return std::sqrt(longest);
}

/// Bound of how much a matrix lengthens: the root of the largest sum of a row of its square.
double lengthening(Mat3 const& m) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    double row = 0;
    for (int j = 0; j < 3; ++j) row += std::fabs(glm::dot(m[i], m[j]));
    most = std::max(most, row);
  }
  return std::sqrt(most);
}

} // namespace

Reach::Reach(Placed const& placed, Transform const& placement) {
  if (placed.shape().ball_radius() < std::numeric_limits<double>::infinity())
    set_ball(placed, placement);
  else if (is_plane(placed.shape()))
    set_plane(placed);
}

void Reach::set_ball(Placed const& placed, Transform const& at) {
  Bounds const own = placed.shape().bounds();
  Vec3 const middle = own.low * 0.5 + own.high * 0.5, half = own.high * 0.5 - own.low * 0.5;
  Vec3 const centre = at.point(middle);
  double radius = placed.shape().ball_radius();
  // How much an error of one rounding of object space is in the world, in terms of the distance.
  double turning = 0;
  if (double const scale = placed.uniform_scale(); scale > 0) {
    radius *= scale;
    turning = sum_of_sizes(scale * placed.inverse_size()[0]);
  } else {
    radius = std::min(half_diagonal(at.linear, half), lengthening(at.linear) * radius);
    Mat3 const back = sizes(at.linear) * placed.inverse_size();
    for (int i = 0; i < 3; ++i) turning = std::max(turning, sum_of_sizes(back[i]));
  }
  if (!(turning <= max_turning_)) return;
  double const off = Placed::rounding * turning * sum_of_sizes(placed.offset_size())
                     + gamma_bound(64) * sum_of_sizes(sizes(at.linear) * glm::abs(middle));
  double const wide = (radius + off) * (1 + share_);
  if (!(wide > smallest && wide < largest && square(centre) < largest * largest)) return;
  place_ = centre;
  size_ = wide * wide;
  kind_ = Kind::Ball;
}

void Reach::set_plane(Placed const& placed) {
  HalfSpaces::Scaled const plane = HalfSpaces::scaled(placed, false);
  place_ = plane.normal;
  size_ = plane.level;
  rest_ = HalfSpaces::at_rest(Vec3(0), Vec3(0), sum_of_sizes(placed.offset_size()));
  kind_ = Kind::Plane;
}

bool Reach::misses_plane(Ray const& ray, double until) const {
  double const at_rest = HalfSpaces::at_rest(ray.origin, ray.origin_error, 0) + rest_;
  double const per_t = HalfSpaces::per_t(ray.direction);
  double const height = glm::dot(place_, ray.origin) - size_;
  double const speed = glm::dot(place_, ray.direction);
  double const above = std::fabs(height), rate = std::fabs(speed);
  if (!(above > at_rest) || !(rate > HalfSpaces::clear_factor * per_t)) return false;
  if ((height > 0) == (speed > 0)) return true;
  double const t = above / rate;
  return (t - until) * rate > at_rest + t * per_t;
}

} // namespace abbe::geometry
