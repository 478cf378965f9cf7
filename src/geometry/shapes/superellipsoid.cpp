// SPDX-License-Identifier: MIT
#include "geometry/shapes/superellipsoid.hpp"

#include "geometry/field_roots.hpp"
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
  bool total() const override { return true; }
  Vec3 gradient(Vec3 const& point) const override;
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

/// The size at a point of places >= 0, and how it grows with each of them.
template <class L>
struct Grown {
  L size;
  lane::Vec<L> share;
};

template <class L>
static Grown<L> grown(lane::Vec<L> const& v, double p, double q) {
  L const zero(0.0), one(1.0);
  struct Pair {
    L size, of_a, of_b;
  };
  // (a^k + b^k)^(1/k) = most (1 + u)^(1/k), u = (least / most)^k.
  auto const joined_pair = [&](L const& a, L const& b, double k) {
    auto const first = b <= a;
    L const most = lane::select(first, a, b);
    L const ratio = lane::select(most == zero, zero, lane::select(first, b, a) / most);
    L const u = lane::exp(L(k) * lane::log(ratio)), whole = one + u;
    L const root = lane::exp(lane::log(whole) * L(1 / k));
    L const of_most = root / whole; // (most / joined)^(k - 1)
    L const at_zero(k > 1 ? 0.0 : k == 1 ? 1.0 : infinity);
    L const of_least = lane::select(ratio == zero, at_zero, of_most * u / ratio);
    return Pair{most * root, lane::select(first, of_most, of_least),
                lane::select(first, of_least, of_most)};
  };
  Pair const ring = joined_pair(v.x, v.y, p), all = joined_pair(ring.size, v.z, q);
  return {all.size, {ring.of_a * all.of_a, ring.of_b * all.of_a, all.of_b}};
}

Vec3 Superellipsoid::Size::gradient(Vec3 const& point) const {
  Vec3 const v = glm::abs(point);
  if (v == Vec3(0)) return v;
  if (v.x == 0 && v.y == 0) return {0, 0, std::copysign(1.0, point.z)};
  auto const share = grown<double>({v.x, v.y, v.z}, p_, q_).share;
  return {std::copysign(share.x, point.x), std::copysign(share.y, point.y),
          std::copysign(share.z, point.z)};
}

/// How far the size is above 1, and how that changes along a line.
template <class L>
struct Superellipsoid::Local {
  L value, slope;
};

template <class L>
Superellipsoid::Local<L> Superellipsoid::local(lane::Vec<L> const& point,
                                               lane::Vec<L> const& direction) const {
  L const zero(0.0);
  Grown<L> const here = grown(lane::abs(point), p_, q_);
  auto const along = [&](L const& place, L const& speed, L const& share) {
    return share * lane::select(place < zero, -speed, speed);
  };
  return {here.size - L(1.0), along(point.x, direction.x, here.share.x)
                                  + along(point.y, direction.y, here.share.y)
                                  + along(point.z, direction.z, here.share.z)};
}

template <class L>
Slice<L> Superellipsoid::slice(Line<L> const& line) const {
  L const zero(0.0), far(infinity);
  lane::Vec<L> const& d = line.direction;
  L const shift = -lane::dot(line.origin, d) / lane::dot(d, d);
  Approach<L> const near = approach(line, shift);
  L const off = lane::sum(near.rounding);
  // From faces of the cube, where the size is above 1.
  L low = -far, high = far;
  auto missed = zero < zero;
  auto const cut = [&](L const& place, L const& speed) {
    L const wall = L(1 + gamma_bound(16)) + off + L(gamma_bound(16)) * lane::abs(place);
    auto const along = speed == zero;
    L const a = (-wall - place) / speed, b = (wall - place) / speed;
    low = lane::max(low, lane::select(along, -far, lane::min(a, b)));
    high = lane::min(high, lane::select(along, far, lane::max(a, b)));
    missed = lane::either(missed, lane::both(along, wall < lane::abs(place)));
  };
  cut(near.point.x, d.x);
  cut(near.point.y, d.y);
  cut(near.point.z, d.z);
  missed = lane::either(missed, lane::negate(low < high));
  auto const at = [&](L const& step) { return local<L>(near.point + step * d, d); };
  Slice<L> out{{far, zero, zero}, {-far, zero, zero}, zero, zero};
  if (lane::none(lane::negate(missed))) return out;

  // Values that rounding cannot tell from zero, of a size near 1.
  L const unsure(gamma_bound(24));
  Local<L> left = at(low), right = at(high);
  constexpr int most_steps = 100;
  for (int i = 0; i < most_steps; ++i) {
    auto const left_open = unsure < left.value, right_open = unsure < right.value;
    auto const open = lane::both(lane::negate(missed), lane::either(left_open, right_open));
    if (lane::none(open)) break;
    // It rises from the left end on, or falls to the right end: 1 is not reached.
    missed = lane::either(
        missed, lane::both(open, lane::either(lane::both(left_open, zero <= left.slope),
                                              lane::both(right_open, right.slope <= zero))));
    L const next_low = lane::select(left_open, low - left.value / left.slope, low);
    L const next_high = lane::select(right_open, high - right.value / right.slope, high);
    missed = lane::either(missed, lane::both(open, next_high < next_low));
    auto const goes_on = lane::both(open, lane::negate(missed));
    if (lane::none(goes_on)) break;
    low = lane::select(goes_on, next_low, low);
    high = lane::select(goes_on, next_high, high);
    left = at(low);
    right = at(high);
  }
  auto const met = lane::both(lane::negate(missed), low < high);
  if (lane::none(met)) return out;
  L const chord = high - low;
  auto const root = [&](L const& step, L const& inwards, L const& slope) {
    lane::Vec<L> const moved = near.rounding + lane::abs(step) * line.direction_rounding;
    L const e = unsure + local<L>(lane::abs(near.point + step * d), moved).slope;
    L const steep = lane::abs(slope);
    L const motion = L(2.0) * e / steep;
    // Outwards it is as steep at least; inwards the value there tells.
    auto const certain = lane::both(motion < chord, at(step + inwards * motion).value < -e);
    L const t = near.t + step;
    return Root<L>{t,
                   lane::select(certain, motion, motion + chord)
                       + L(gamma_bound(2)) * (lane::abs(t) + lane::abs(step)),
                   L(2.0) * lane::sum(line.slack) / steep};
  };
  out.in = select(met, root(low, L(1.0), left.slope), out.in);
  out.out = select(met, root(high, L(-1.0), right.slope), out.out);
  return out;
}

Superellipsoid::Superellipsoid(double east, double north)
    : p_(2 / east),
      q_(2 / north),
      convex_(p_ >= 1 && q_ >= 1),
      size_(std::make_shared<Size>(east, north)),
      ball_(std::sqrt(3.0) * (1 + gamma_bound(8))) {}
Superellipsoid::~Superellipsoid() = default;

void Superellipsoid::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  if (convex_) return ConvexShape::crossings(ray, start, out);
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
    std::sort(stops, stops + count);
    for (int i = 0; i + 1 < count; ++i) {
      if (stops[i] < stops[i + 1]) field_roots(line, stops[i], stops[i + 1], roots);
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
