// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"
#include "geometry/half_spaces.hpp"
#include "simd/float_lanes.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

/// Which of many half-spaces can matter to some rays of a fan: in floats, eight rays at a time,
/// with bounds of their rounding. What is left is computed in doubles, so that no bit depends on
/// this.
namespace abbe::geometry {

/// What ConvexCut::apply_departure finds for all rays of a fan alike.
struct CutDeparture {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t plane = none; ///< that they start on
  bool to_inside = false;
  bool unclear = false; ///< more than one, or one twice
};
inline CutDeparture departure_of(HalfSpaces const& planes, Departure const* from) {
  CutDeparture out;
  if (from == nullptr) return out;
  for (Departure::On const& on : from->on) {
    std::size_t const k = planes.place_of(on.primitive);
    if (k == CutDeparture::none) continue;
    out.unclear = out.unclear || out.plane != CutDeparture::none;
    out.plane = k;
    out.to_inside = (on.was_entering == from->through) != planes.outside_counts(k);
  }
  return out;
}

/// Rays of one filter.
inline constexpr std::size_t filter_rays = 8;

/// Places of half-spaces, ascending.
struct PlaneList {
  static constexpr std::size_t most = 128; ///< planes; those of more are not filtered
  static constexpr std::size_t least = 12; ///< fewer are asked faster than told apart
  std::array<std::uint16_t, most> place;
  std::size_t count = 0;
};

/// Rays and their bounds, in floats.
struct FilterRays {
  alignas(32) float ox[filter_rays], oy[filter_rays], oz[filter_rays];
  alignas(32) float dx[filter_rays], dy[filter_rays], dz[filter_rays];
  /// Of the height over a plane, of the speed towards it: rounding, and twice the parts of the
  /// error of t that HalfSpaces speaks of.
  alignas(32) float height_error[filter_rays], speed_error[filter_rays];
};

/// @return false where floats are too narrow for the numbers
inline bool fill_filter(HalfSpaces const& planes, FanLines const& rays, bool departs,
                        std::size_t first, FilterRays& out) {
  constexpr double narrow = 0x1p-80, wide = 0x1p80;
  // Eight roundings of 2^-24, and some more for the bound itself.
  constexpr double rounding = 8.5 * 0x1p-24;
  bool fits = true;
  for (std::size_t j = 0; j < filter_rays; ++j) {
    std::size_t const k = std::min(first + j, rays.count - 1);
    auto const vec = [k](FanVectors const& v) { return lane::Vec<double>{v.x[k], v.y[k], v.z[k]}; };
    lane::Vec<double> const o = vec(rays.origin), d = vec(rays.direction);
    lane::Vec<double> const error = departs ? vec(rays.origin_error) : lane::Vec<double>{};
    double const reach = lane::sum(lane::abs(o)) + planes.widest_level();
    double const speed = lane::sum(lane::abs(d));
    double const at_rest = planes.at_rest_of(o, error), per_t = planes.per_t_of(d);
    fits =
        fits && reach > narrow && reach < wide && speed > narrow && speed < wide && at_rest < wide;
    out.ox[j] = static_cast<float>(o.x);
    out.oy[j] = static_cast<float>(o.y);
    out.oz[j] = static_cast<float>(o.z);
    out.dx[j] = static_cast<float>(d.x);
    out.dy[j] = static_cast<float>(d.y);
    out.dz[j] = static_cast<float>(d.z);
    out.height_error[j] = static_cast<float>(rounding * reach + 2 * at_rest);
    out.speed_error[j] = static_cast<float>(rounding * speed + 2 * per_t);
  }
  return fits;
}

/// The planes that any of the rays from `first` on may leave first, may be outside of, or be
/// unclear about. The others have no part in what first_end_of() (fan_cut.hpp) finds: rays start
/// inside of them and near none, or leave them later than another, by more than the errors of both.
/// @param departure of the rays @tparam F eight floats
template <class F>
void list_planes(HalfSpaces const& planes, FanLines const& rays, Departure const* from,
                 CutDeparture const& departure, std::size_t first, PlaneList& out) {
  std::size_t const count = planes.count();
  out.count = 0;
  auto const list = [&](std::size_t k) { out.place[out.count++] = static_cast<std::uint16_t>(k); };
  // What leaves a convex solid has nothing of it ahead, or is unclear about that plane.
  if (departure.plane != CutDeparture::none && !departure.to_inside) return list(departure.plane);
  FilterRays r;
  if (!fill_filter(planes, rays, from != nullptr, first, r)) {
    for (std::size_t k = 0; k < count; ++k) list(k);
    return;
  }
  // Nearly parallel is a speed of less than so many errors; so t is known to a few thousandths,
  // which `later` pays for.
  F const clear(1024), later(1.005F), zero(0), one(1), never(HUGE_VALF);
  F const ox = F::load(r.ox), oy = F::load(r.oy), oz = F::load(r.oz), dx = F::load(r.dx),
          dy = F::load(r.dy), dz = F::load(r.dz), height_error = F::load(r.height_error),
          speed_error = F::load(r.speed_error), steep = clear * speed_error;
  alignas(32) float leaves[PlaneList::most][filter_rays]; // after that; -never: to be listed
  F first_out(FLT_MAX);
  for (std::size_t k = 0; k < count; ++k) {
    auto const& plane = planes.narrow_plane(k);
    F const nx(plane.x), ny(plane.y), nz(plane.z);
    F const depth = F(plane.level) - (nx * ox + ny * oy + nz * oz);
    F const speed = nx * dx + ny * dy + nz * dz;
    F const slowness = one / (speed + speed_error);
    auto const inside = height_error < depth;
    auto const away = both(inside, steep < speed), nearing = both(inside, speed < zero - steep);
    F const soonest = (depth - height_error) * slowness, latest = (depth + height_error) * slowness;
    select(away, soonest, select(nearing, never, zero - never)).store(leaves[k]);
    first_out = select(both(away, latest < first_out), latest, first_out);
  }
  first_out = later * first_out;
  for (std::size_t k = 0; k < count; ++k)
    if (k == departure.plane || !every(first_out < F::load(leaves[k]))) list(k);
}

} // namespace abbe::geometry
