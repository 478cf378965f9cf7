// SPDX-License-Identifier: MIT
#include "geometry/shapes/torus.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/bracket.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/start.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace abbe::geometry {

namespace {

/// Points where a polynomial of degree 3, 2 or less changes sign in (-1, 1), ascending.
struct Stops {
  std::array<double, 5> at{};
  int count = 0;
  void add(double x) {
    if (x > -1 && x < 1 && (count == 0 || x > at[static_cast<std::size_t>(count - 1)])) {
      at[static_cast<std::size_t>(count++)] = x;
    }
  }
};

Stops quadratic_stops(double a, double half_b, double c) {
  Stops stops;
  double const discriminant = lane::difference_of_products(half_b, half_b, a, c);
  if (!(discriminant >= 0)) return stops;
  double const q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  double const first = q / a, second = c / q;
  stops.add(std::fmin(first, second));
  stops.add(std::fmax(first, second));
  return stops;
}

/// a x^3 + b x^2 + c x + d, between the zeros of its derivative.
Stops cubic_stops(double a, double b, double c, double d) {
  auto const f = [&](double x) {
    return std::pair{((a * x + b) * x + c) * x + d, (3 * a * x + 2 * b) * x + c};
  };
  Stops const turning = quadratic_stops(3 * a, b, c);
  Stops stops;
  double low = -1, low_value = f(low).first;
  for (int i = 0; i <= turning.count; ++i) {
    double const high = i < turning.count ? turning.at[static_cast<std::size_t>(i)] : 1;
    double const high_value = f(high).first;
    if ((low_value < 0) != (high_value < 0)) {
      stops.add(bracketed_root(f, low, high, low_value < 0));
    }
    low = high;
    low_value = high_value;
  }
  return stops;
}

} // namespace

void Torus::roots(Ray const& ray, bool all, Crossings& out) const {
  Line<double> const line = line_of(ray);
  Vec3 const& d = ray.direction;
  double const length2 = glm::dot(d, d), length = std::sqrt(length2);
  Approach<double> const near = approach(line, -glm::dot(ray.origin, d) / length2);
  Vec3 const p(near.point.x, near.point.y, near.point.z);
  double const rounding = lane::sum(near.rounding);
  // The window, wide enough for all roundings.
  double const reach = (major_ + minor_) * (1 + gamma_bound(16)) + rounding;
  double const distance = std::sqrt(glm::dot(p, p));
  if (!(distance <= reach)) return;
  double const half =
      std::sqrt((reach - distance) * (reach + distance)) / length * (1 + gamma_bound(16));
  double low = -half, high = half;
  double const height = minor_ * (1 + gamma_bound(16)) + rounding;
  if (d.y == 0) {
    if (std::fabs(p.y) > height) return;
  } else {
    double const a = (-height - p.y) / d.y, b = (height - p.y) / d.y;
    low = std::fmax(low, std::fmin(a, b));
    high = std::fmin(high, std::fmax(a, b));
  }
  if (!(low < high)) return;
  double const middle = 0.5 * (low + high), scale = 0.5 * (high - low);
  Vec3 const q = p + middle * d, e = scale * d;
  // Through the hole: the distance from the axis is largest at an end.
  double const hole = major_ - minor_ - (major_ + minor_) * gamma_bound(32) - rounding;
  auto const axis_distance2 = [](Vec3 const& at) { return at.x * at.x + at.z * at.z; };
  if (hole > 0 && std::max(axis_distance2(q - e), axis_distance2(q + e)) < hole * hole) return;

  // (A + 2 B w + C w^2)^2 - 4 R^2 (a + 2 b w + c w^2), by its derivative's coefficients / 4.
  double const big_a = glm::dot(q, q) + (major_ - minor_) * (major_ + minor_);
  double const big_b = glm::dot(q, e), big_c = glm::dot(e, e), r2 = 2 * major_ * major_;
  double const b = q.x * e.x + q.z * e.z, c = e.x * e.x + e.z * e.z;
  Stops stops = cubic_stops(big_c * big_c, 3 * big_b * big_c,
                            2 * big_b * big_b + big_a * big_c - r2 * c, big_a * big_b - r2 * b);

  auto const f = [&](double w) {
    Vec3 const at = q + w * e;
    double const rho = std::sqrt(at.x * at.x + at.z * at.z), g = rho - major_;
    double const tube = std::sqrt(g * g + at.y * at.y);
    double const turn = rho == 0 ? 0 : (at.x * e.x + at.z * e.z) / rho;
    return std::pair{(tube - minor_) * (tube + minor_), 2 * (g * turn + at.y * e.y)};
  };
  double from = -1;
  bool from_inside = false; // nothing is inside at the ends of the window
  for (int i = 0; i <= stops.count; ++i) {
    bool const end = i == stops.count;
    double const to = end ? 1 : stops.at[static_cast<std::size_t>(i)];
    bool const to_inside = !end && f(to).first < 0;
    // Where this piece ends, less what roundings come to.
    double const until = near.t + middle + scale * to - 0x1p-20 * scale;
    if (from_inside != to_inside && (all || until > 0)) {
      double const w = bracketed_root(f, from, to, from_inside);
      double const slope = 0.5 * f(w).second / scale, step = middle + scale * w, t = near.t + step;
      lane::Vec<double> const moved = near.rounding + std::fabs(step) * line.direction_rounding;
      double const error = minor_ * (lane::sum(moved) + gamma_bound(8) * (major_ + minor_));
      out.push_back({t,
                     root_motion(error, slope, length2)
                         + gamma_bound(2) * (std::fabs(t) + std::fabs(middle) + scale),
                     root_motion(minor_ * lane::sum(line.slack), slope, length2), 0, to_inside,
                     true, true});
      if (Crossing const& found = out.back();
          !all && found.t > found.error && found.t + found.error < until)
        return;
    }
    from = to;
    from_inside = to_inside;
  }
}

void Torus::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  roots(ray, true, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void Torus::crossings_ahead(Ray const& ray, Start const* start, double, Crossings& out) const {
  if (start != nullptr) return crossings(ray, start, out);
  roots(ray, false, out);
}

bool Torus::inside(Vec3 const& point) const {
  return simd::hypot(simd::hypot(point.x, point.z) - major_, point.y) <= minor_;
}

Vec3 Torus::normal(Vec3 const& point, std::uint32_t) const {
  double const rho = simd::hypot(point.x, point.z);
  double const part = rho == 0 ? 0 : (rho - major_) / rho;
  Vec3 const out(point.x * part, point.y, point.z * part);
  return out == Vec3(0) ? Vec3(0, 1, 0) : unit_vector(out);
}

/// Round the y axis, and round the tube.
std::optional<Vec2> Torus::uv(Vec3 const& point, std::uint32_t) const {
  constexpr double pi = std::numbers::pi;
  double const beyond = simd::hypot(point.x, point.z) - major_;
  return Vec2(1 - (simd::atan2(point.z, point.x) + pi) / (2 * pi),
              (simd::atan2(point.y, beyond) + pi) / (2 * pi));
}

Bounds Torus::bounds() const {
  double const reach = major_ + minor_;
  return {{-reach, -minor_, -reach}, {reach, minor_, reach}};
}

std::optional<PlacedShape> make_torus(double major, double minor) {
  if (!std::isfinite(major) || !usable_size(minor)) return std::nullopt;
  if (major == 0) return make_sphere(Vec3(0), minor);
  return PlacedShape{std::make_shared<Torus>(std::fabs(major), std::fabs(minor)), {}};
}

std::optional<PlacedShape> read_torus(Parameters& parameters) {
  double const major = parameters.number("major radius");
  double const minor = parameters.number("minor radius");
  (void)parameters.flag("sturm");
  if (minor == 0)
    return left_out(parameters, "E0608", "a torus whose minor radius is 0 is not drawn");
  if (major < 0 || minor < 0)
    parameters.report(Severity::Warning, "E0608",
                      "the radii of this torus count as positive (POV-Ray draws something else)");
  return or_report(make_torus(major, minor), parameters, "E0608", "a torus needs finite radii");
}

} // namespace abbe::geometry
