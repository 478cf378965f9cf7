// SPDX-License-Identifier: MIT
#include "geometry/shapes/superellipsoid.hpp"

#include "geometry/field_roots.hpp"
#include "geometry/shapes/bracket.hpp"
#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abbe::geometry {

namespace {

constexpr int library = 16; ///< roundings of the chain of powers, each of 2 units at most

/// (a^k + b^k)^(1/k), a, b >= 0.
double joined(double a, double b, double k) {
  double const most = std::max(a, b), least = std::min(a, b);
  if (most == 0) return 0;
  return most * simd::pow(1 + simd::pow(least / most, k), 1 / k);
}

} // namespace

/// The size as a field.
class Superellipsoid::Size final : public ScalarField {
public:
  Size(double east, double north) : p_(2 / east), q_(2 / north) {}

  double value(Vec3 const& point) const override {
    Vec3 const v = glm::abs(point);
    return joined(joined(v.x, v.y, p_), v.z, q_);
  }
  bool smooth() const override { return true; }
  Vec3 gradient(Vec3 const& point) const override {
    Vec3 const v = glm::abs(point);
    double const ring = joined(v.x, v.y, p_), size = joined(ring, v.z, q_);
    if (size == 0) return Vec3(0);
    double const to_ring = ring > 0 ? simd::pow(ring / size, q_ - 1) : 0;
    auto const share = [](double part, double whole, double k) {
      return whole > 0 ? simd::pow(part / whole, k - 1) : 0.0;
    };
    return {std::copysign(share(v.x, ring, p_) * to_ring, point.x),
            std::copysign(share(v.y, ring, p_) * to_ring, point.y),
            std::copysign(share(v.z, size, q_), point.z)};
  }
  Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const override {
    Interval v[3];
    Vec3 low, high;
    for (int i = 0; i < 3; ++i) {
      v[i] = direction[i] == 0 ? Interval(origin[i])
                               : Interval(origin[i]) + Interval(direction[i]) * part;
      Interval const size = abs(v[i]);
      low[i] = size.low;
      high[i] = size.high;
    }
    double const ring_low = joined(low.x, low.y, p_), ring_high = joined(high.x, high.y, p_);
    Interval const ring = widened(ring_low, ring_high, library);
    Interval const size =
        widened(joined(ring_low, low.z, q_), joined(ring_high, high.z, q_), 2 * library);
    auto const of = [](Interval const& x) { return Interval(std::max(x.low, 0.0), x.high); };
    Interval const to_ring = share(of(ring), of(size), q_);
    Interval slope(0);
    slope = slope + signed_share(v[0], share(abs(v[0]), of(ring), p_) * to_ring, direction.x);
    slope = slope + signed_share(v[1], share(abs(v[1]), of(ring), p_) * to_ring, direction.y);
    slope = slope + signed_share(v[2], share(abs(v[2]), of(size), q_), direction.z);
    return {size, slope};
  }

  /// Where both powers are at least 1, the size is a norm: along a line it falls, then rises.
  bool convex() const { return p_ >= 1 && q_ >= 1; }
  bool convex_roots(FieldLine const& line, double low, double high,
                    std::vector<FieldRoot>& roots) const;

private:
  /// (part / whole)^(k - 1), 0 <= part <= whole.
  static Interval share(Interval const& part, Interval const& whole, double k) {
    double const low = whole.high > 0 ? std::max(part.low, 0.0) / whole.high : 0;
    double const high = whole.low > 0 ? std::min(1.0, part.high / whole.low) : 1;
    double const a = simd::pow(low, k - 1), b = simd::pow(high, k - 1);
    // The ratio's roundings count as often as the power says.
    int const roundings = library + static_cast<int>(std::min(8 * std::fabs(k), 1e6));
    Interval const result = widened(std::min(a, b), std::max(a, b), roundings);
    return {std::max(result.low, 0.0), result.high};
  }
  static Interval signed_share(Interval const& place, Interval const& share, double speed) {
    if (speed == 0) return 0;
    Interval const size = share * Interval(speed);
    if (place.low > 0) return size;
    if (place.high < 0) return -size;
    return hull(size, -size);
  }

  double p_, q_;
};

/// The short way: tangents from both sides part what can be inside from what cannot (Kelley).
/// @return false, with nothing appended, where rounding could decide: for field_roots
bool Superellipsoid::Size::convex_roots(FieldLine const& line, double low, double high,
                                        std::vector<FieldRoot>& roots) const {
  auto const at = [&](double t) {
    Vec3 const p = line.origin + t * line.direction;
    return std::pair{value(p) - 1, glm::dot(gradient(p), line.direction)};
  };
  // Of values near 1 or below; those above only part more.
  double const doubt = 4 * library * gamma_bound(2);
  auto left = at(low), right = at(high);
  double a = low, b = high, inner = low;
  bool found = false;
  for (int i = 0; i < 60 && !found; ++i) {
    if (!(left.second < 0 && right.second > 0)) {
      // It falls or rises all the way from an end that is outside.
      return left.second > 0 && left.first > doubt ? true : right.second < 0 && right.first > doubt;
    }
    // Where the tangents meet, the size is not below them.
    double const meet = (right.first - left.first + left.second * a - right.second * b)
                        / (left.second - right.second);
    double const bound = left.first + left.second * (meet - a);
    if (bound > doubt * (2 + std::fabs(left.first) + std::fabs(right.first))) return true;
    double const next = meet > a && meet < b ? meet : 0.5 * (a + b);
    auto const middle = at(next);
    if (!(next > a && next < b)) return false;
    if (middle.first < -doubt) {
      found = true;
      inner = next;
    } else if (middle.second < 0) {
      a = next;
      left = middle;
    } else {
      b = next;
      right = middle;
    }
  }
  if (!found) return false;
  for (bool const rising : {false, true}) {
    double const from = rising ? inner : a, to = rising ? b : inner;
    if (!((rising ? right : left).first > doubt)) {
      roots.clear();
      return false;
    }
    FieldRoot root;
    root.rising = rising;
    root.at = bracketed_root(at, from, to, rising);
    root.error = field_root_error(line, root.at, rising, high - low);
    roots.push_back(root);
  }
  return true;
}

Superellipsoid::Superellipsoid(double east, double north)
    : size_(std::make_shared<Size>(east, north)), ball_(std::sqrt(3.0) * (1 + gamma_bound(8))) {}
Superellipsoid::~Superellipsoid() = default;

void Superellipsoid::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  CloseLine const close(ray, ball_);
  std::size_t const first = out.size();
  double low = -close.half, high = close.half;
  for (int i = 0; i < 3 && low < high; ++i) {
    double const margin = close.near.rounding.x + close.near.rounding.y + close.near.rounding.z
                          + gamma_bound(16) * (1 + std::fabs(close.point[i]));
    double const d = close.direction[i], p = close.point[i];
    if (d == 0) {
      if (std::fabs(p) > 1 + margin) high = low;
      continue;
    }
    double const a = (-1 - margin - p) / d, b = (1 + margin - p) / d;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  if (low < high) {
    // In units of a power of two, so that a line of any speed gives the same bits.
    double const unit = std::exp2(-std::ilogb(vector_length(close.direction)));
    FieldLine const line{*size_, close.point, close.direction * unit, 1, 0, infinity};
    std::vector<FieldRoot> roots;
    // Parted where a coordinate changes its sign: smooth between.
    double stops[5] = {low / unit, high / unit, 0, 0, 0};
    int count = 2;
    for (int i = 0; i < 3; ++i) {
      double const at = -line.origin[i] / line.direction[i];
      if (at > stops[0] && at < stops[1]) stops[count++] = at;
    }
    if (!(size_->convex() && size_->convex_roots(line, stops[0], stops[1], roots))) {
      std::sort(stops, stops + count);
      for (int i = 0; i + 1 < count; ++i) {
        if (stops[i] < stops[i + 1]) field_roots(line, stops[i], stops[i + 1], roots);
      }
    }
    for (FieldRoot const& root : roots) {
      Vec3 const at = line.origin + root.at * line.direction;
      Vec3 const gradient = size_->gradient(at), size = glm::abs(gradient);
      double const slope = glm::dot(gradient, line.direction);
      Crossing c;
      double const step = root.at * unit;
      c.t = close.near.t + step;
      Vec3 const moved = close.moved(c.t) + Vec3(close.place_error<double>(step));
      c.error = unit * (root.error + root_motion(glm::dot(size, moved), slope, 1.0))
                + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step));
      c.slack = unit * root_motion(glm::dot(size, close.slack()), slope, 1.0);
      c.entering = !root.rising;
      out.push_back(c);
    }
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

bool Superellipsoid::inside(Vec3 const& point) const {
  return size_->value(point) <= 1;
}

Vec3 Superellipsoid::normal(Vec3 const& point, std::uint32_t) const {
  Vec3 const slope = size_->gradient(point);
  if (slope == Vec3(0) || !finite(slope)) {
    // An edge or tip that is sharp: away from the middle.
    return point == Vec3(0) ? Vec3(0, 1, 0) : unit_vector(point);
  }
  return unit_vector(slope);
}

std::optional<PlacedShape> make_superellipsoid(double east, double north) {
  bool const good = std::isfinite(2 / east) && std::isfinite(2 / north) && east > 0 && north > 0
                    && std::isfinite(east) && std::isfinite(north);
  if (!good) return std::nullopt;
  return PlacedShape{std::make_shared<Superellipsoid>(east, north), {}};
}

std::optional<PlacedShape> read_superellipsoid(Parameters& parameters) {
  constexpr double sharpest = 1e-4; // no picture tells it from 0
  Vec2 roundness = parameters.vec2("roundness <e, n>");
  for (int i = 0; i < 2; ++i) {
    if (roundness[i] != 0) continue;
    roundness[i] = sharpest;
    parameters.report(Severity::Warning, "E0627", "a roundness of 0 is taken as the sharpest edge");
  }
  return or_report(make_superellipsoid(roundness.x, roundness.y), parameters, "E0627",
                   "a superellipsoid needs two finite numbers above zero");
}

} // namespace abbe::geometry
