// SPDX-License-Identifier: MIT
#include "geometry/shapes/ovus.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/start.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

Ovus::Ovus(double bottom, double top)
    : bottom_(bottom), top_(top), arc_(2 * std::max(bottom, top)) {
  // The arc touches both balls from outside: its middle is arc_ - radius away from their middles.
  double const a = arc_ - bottom, b = arc_ - top;
  height_ = ((a - b) * (a + b) + bottom * bottom) / (2 * bottom);
  away_ = std::sqrt(std::max(0.0, (a - height_) * (a + height_)));
  low_joint_ = -bottom * height_ / a;
  high_joint_ = bottom + top * (bottom - height_) / b;
  double const wide = std::max(std::max(bottom, top), arc_ - away_) * (1 + gamma_bound(16));
  bounds_ = {{-wide, -bottom, -wide}, {wide, bottom + top, wide}, false};
  ball_ = vector_length(bounds_.high - bounds_.low) / 2 * (1 + gamma_bound(8));
}

Ovus::Local Ovus::distance(Vec3 const& p, std::uint32_t face) const {
  double const r = std::sqrt(p.x * p.x + p.z * p.z);
  if (face == 1) {
    double const x = r + away_, y = p.y - height_, length = std::sqrt(x * x + y * y);
    double const share = r > 0 ? x / (length * r) : 0;
    return {length - arc_, Vec3(p.x * share, y / length, p.z * share), 1};
  }
  Vec3 const from = face == 0 ? p : p - Vec3(0, bottom_, 0);
  double const length = glm::length(from), radius = face == 0 ? bottom_ : top_;
  return {length - radius, length > 0 ? from / length : Vec3(0, face == 0 ? -1 : 1, 0), face};
}

Ovus::Local Ovus::distance(Vec3 const& p) const {
  // Which part is nearest: by the lines from the arc's middle through those of the balls.
  double const r = std::sqrt(p.x * p.x + p.z * p.z);
  double const x = r + away_, y = p.y - height_;
  // Below the line to the lower middle (away_, -height_), above that to the upper one.
  if (away_ * y + height_ * x < 0) return distance(p, 0);
  if (away_ * y - (bottom_ - height_) * x > 0) return distance(p, 2);
  return distance(p, 1);
}

void Ovus::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  Line<double> const line = line_of(ray);
  Vec3 const middle = bounds_.low * 0.5 + bounds_.high * 0.5, d = ray.direction;
  double const length2 = glm::dot(d, d), length = std::sqrt(length2);
  Approach<double> const near = approach(line, -glm::dot(ray.origin - middle, d) / length2);
  Vec3 const p(near.point.x, near.point.y, near.point.z);
  double const miss = glm::length(p - middle);
  if (miss < ball_ && length2 > 0) {
    double const half = std::sqrt((ball_ - miss) * (ball_ + miss)) / length * (1 + gamma_bound(32));
    auto const root = [&](double from, bool entering, Crossing& c) {
      double step = from;
      for (int i = 0; i < 100; ++i) {
        Local const here = distance(p + step * d);
        double const slope = glm::dot(here.outward, d);
        // Beyond the lowest place, above the level: there is no root.
        bool const falls = entering ? slope < 0 : slope > 0;
        if (here.value > 0 && !falls) return false;
        double const next = step - here.value / slope;
        bool const done =
            !(here.value > 0) || next == step || !(entering ? next > step : next < step) || i == 99;
        if (done) {
          step = here.value > 0 || !falls ? step : next;
          Vec3 const moved(near.rounding.x + std::fabs(step) * line.direction_rounding.x,
                           near.rounding.y + std::fabs(step) * line.direction_rounding.y,
                           near.rounding.z + std::fabs(step) * line.direction_rounding.z);
          double const least = std::max(std::min(bottom_, top_), 1e-300);
          double const bend = length2 / least, steep = std::fabs(slope);
          double const e = moved.x + moved.y + moved.z + gamma_bound(24) * arc_;
          c.t = near.t + step;
          c.error = std::min(root_motion(e, steep, bend), 2 * half)
                    + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step));
          c.slack = root_motion(line.slack.x + line.slack.y + line.slack.z, steep, bend);
          c.face = here.face;
          c.entering = entering;
          return true;
        }
        step = next;
      }
      return false;
    };
    Crossing in, leave;
    if (root(-half, true, in) && root(half, false, leave) && in.t < leave.t) {
      out.push_back(in);
      out.push_back(leave);
    }
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

Vec3 Ovus::normal(Vec3 const& point, std::uint32_t face) const {
  Vec3 const outward = distance(point, face).outward;
  return outward == Vec3(0) ? Vec3(0, 1, 0) : unit_vector(outward);
}

std::optional<Vec2> Ovus::uv(Vec3 const& point, std::uint32_t) const {
  double const turn = simd::atan2(point.z, point.x) / 6.283185307179586476925286766559;
  // By the angle about the middle of its height, from below.
  double const r = simd::hypot(point.x, point.z), up = point.y - top_ * 0.5;
  return Vec2(turn < 0 ? turn + 1 : turn, simd::atan2(r, -up) / 3.14159265358979323846);
}

std::optional<PlacedShape> make_ovus(double bottom, double top) {
  double const largest = std::max(bottom, top);
  if (!(bottom >= 0) || !(top >= 0) || !usable_size(largest)) return std::nullopt;
  if (top >= 2 * bottom) return make_sphere({0, bottom, 0}, top);
  double const unit = std::exp2(std::ilogb(largest));
  return PlacedShape{std::make_shared<Ovus>(bottom / unit, top / unit),
                     Transform::scaling(Vec3(unit))};
}

std::optional<PlacedShape> read_ovus(Parameters& parameters) {
  double const bottom = parameters.number("bottom radius"), top = parameters.number("top radius");
  if (bottom == 0 && top == 0)
    return left_out(parameters, "E0637", "an ovus of the radii 0 is not drawn");
  return or_report(make_ovus(bottom, top), parameters, "E0637",
                   "the radii of an ovus must not be negative or out of range");
}

} // namespace abbe::geometry
