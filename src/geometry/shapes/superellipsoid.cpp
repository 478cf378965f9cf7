// SPDX-License-Identifier: MIT
#include "geometry/shapes/superellipsoid.hpp"

#include "geometry/field_roots.hpp"
#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"
#include "geometry/shapes/superellipsoid_size.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abbe::geometry {

/// How far the size is above 1, and how that changes along a line.
template <class L>
struct Superellipsoid::Local {
  L value, slope;
};

template <class L>
Superellipsoid::Local<L> Superellipsoid::local(lane::Vec<L> const& point,
                                               lane::Vec<L> const& direction) const {
  L const zero(0.0);
  GrownSize<L> const here = grown_size(lane::abs(point), p_, q_);
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

/// Planes n . |v| = 1 that the shape does not pass where it is not convex.
static std::vector<Vec3> faces_of(double p, double q) {
  std::vector<Vec3> faces;
  // (a^k + b^k)^(1/k) is at least a + b where k <= 1, and that times 2^(1/k - 1) else.
  double const ring = p <= 1 ? 1 : simd::pow(2.0, 1 / p - 1);
  double const all = q <= 1 ? 1 : simd::pow(2.0, 1 / q - 1);
  if (p <= 1) faces.emplace_back(1, 1, 0);
  faces.emplace_back(ring * all, ring * all, all);
  if (q <= 1) {
    faces.emplace_back(1, 0, 1);
    faces.emplace_back(0, 1, 1);
  }
  return faces;
}

Superellipsoid::Superellipsoid(double east, double north)
    : p_(2 / east),
      q_(2 / north),
      convex_(p_ >= 1 && q_ >= 1),
      size_(std::make_shared<SuperellipsoidSize>(p_, q_)),
      ball_(std::sqrt(3.0) * (1 + gamma_bound(8))),
      faces_(convex_ ? std::vector<Vec3>{} : faces_of(p_, q_)) {}
Superellipsoid::~Superellipsoid() = default;

namespace {

/// Where a line comes into the cube [-1, 1]^3, goes through the planes of coordinates, and leaves
/// the cube.
struct Stops {
  double at[5]{};
  double blur[5]{}; ///< how far off those between the ends may be
  int count = 0;    ///< 0: the line passes by

  /// @param half the line is looked at from -half to half
  Stops(FieldLine const& line, double half) {
    double low = -half, high = half;
    for (int i = 0; i < 3 && low < high; ++i) {
      double const wall = 1 + slim, d = line.direction[i], p = line.origin[i];
      if (d == 0) {
        if (std::fabs(p) > wall) high = low;
        continue;
      }
      double const a = (-wall - p) / d, b = (wall - p) / d;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    if (!(low < high)) return;
    at[count++] = low;
    for (int i = 0; i < 3; ++i) {
      double const place = -line.origin[i] / line.direction[i];
      if (!(place > low && place < high)) continue;
      int k = count++;
      double const off = 4 * gamma_bound(4) * std::fabs(place);
      for (; k > 1 && at[k - 1] > place; --k) {
        at[k] = at[k - 1];
        blur[k] = blur[k - 1];
      }
      at[k] = place;
      blur[k] = off;
    }
    at[count++] = high;
  }

  /// Is it certain that the line does not come to the level? Between stops of a `concave` size it
  /// is nowhere below what it is at both ends.
  bool pass_by(FieldLine const& line, bool concave) const {
    if (count == 0) return true;
    if (!concave) return false;
    LinePieces pieces;
    pieces.count = LinePieces::most;
    for (int i = 0; i < LinePieces::most; ++i) {
      int const k = std::min(i, count - 1);
      pieces.low[i] = at[k] - blur[k];
      pieces.high[i] = at[k] + blur[k];
    }
    line.field.along_each(line.origin, line.direction, pieces);
    return std::all_of(pieces.value_low, pieces.value_low + count,
                       [&](double value) { return value > line.level; });
  }

  /// How far outside of the shape ends of the search lie, so that they are certainly outside.
  static constexpr double slim = 0x1p-30;
};

} // namespace

/// Cuts off what lies beyond `faces_` of a piece that keeps to one octant.
void Superellipsoid::cut_by_faces(FieldLine const& line, double& low, double& high) const {
  Vec3 const middle = line.origin + (0.5 * low + 0.5 * high) * line.direction;
  Vec3 const sign(std::copysign(1.0, middle.x), std::copysign(1.0, middle.y),
                  std::copysign(1.0, middle.z));
  for (Vec3 const& face : faces_) {
    double const place = glm::dot(face * sign, line.origin),
                 speed = glm::dot(face * sign, line.direction);
    double const at = (1 + Stops::slim - place) / speed;
    if (speed > 0)
      high = std::min(high, at);
    else if (speed < 0)
      low = std::max(low, at);
    else if (place > 1 + Stops::slim)
      high = low;
  }
}

void Superellipsoid::search(CloseLine const& close, double from, double until, double enough,
                            Crossings& out) const {
  // In units of a power of two, so that a line of any speed gives the same bits.
  double const unit = std::exp2(-std::ilogb(vector_length(close.direction)));
  auto const at = [&](double t) { return (t - close.near.t) / unit; };
  FieldLine const line{*size_, close.point, close.direction * unit, 1, 0, at(enough)};
  Stops const stops(line, close.half / unit);
  if (stops.pass_by(line, p_ <= 1 && q_ <= 1)) return;
  std::vector<FieldRoot> roots;
  for (int i = 0; i + 1 < stops.count; ++i) {
    double low = stops.at[i], high = stops.at[i + 1];
    if (high < at(from)) continue;
    if (low > at(until)) break;
    cut_by_faces(line, low, high);
    if (low < high) field_roots(line, low, high, roots);
    if (!roots.empty() && roots.back().at - roots.back().error > line.enough) break;
  }
  for (FieldRoot const& root : roots) {
    Vec3 const place = line.origin + root.at * line.direction;
    Vec3 const gradient = size_->gradient(place), size = glm::abs(gradient);
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

void Superellipsoid::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  if (convex_) return ConvexShape::crossings(ray, start, out);
  std::size_t const first = out.size();
  search(CloseLine(ray, ball_), -infinity, infinity, infinity, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void Superellipsoid::crossings_ahead(Ray const& ray, Start const* start, double until,
                                     Crossings& out) const {
  if (convex_) return ConvexShape::crossings(ray, start, out);
  CloseLine const close(ray, ball_);
  double const margin = close.margin();
  if (start == nullptr) return search(close, -margin, until + margin, margin, out);
  // The known root is as near as the origin is known, unless the ray grazes: then all are looked
  // at.
  Vec3 const blur = ray.origin_error + ray.origin_rounding + 0x1p-50 * glm::abs(ray.origin);
  double const near = margin + 16 * vector_length(blur) / vector_length(ray.direction);
  std::size_t const first = out.size();
  search(close, -near, until + near, near, out);
  if (has_start(*start, near, first, out)) return impose_start(*start, false, first, out);
  out.resize(first);
  crossings(ray, start, out);
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
