// SPDX-License-Identifier: MIT
#include "geometry/batch.hpp"

#include "geometry/fan.hpp"
#include "geometry/world_impl.hpp"

#include <algorithm>
#include <bit>

namespace abbe::geometry {

void Hits::resize(std::size_t count) {
  std::size_t const room = (count + 7) / 8 * 8;
  if (hit.size() < count) {
    hit.resize(room);
    group.resize(room);
    t.resize(room);
    error.resize(room);
    vectors_.resize(6 * room);
  }
  double* at = vectors_.data();
  std::size_t const each = vectors_.size() / 6;
  for (double** const values :
       {&point.x, &point.y, &point.z, &point_error.x, &point_error.y, &point_error.z}) {
    *values = at;
    at += each;
  }
  groups.clear();
}

std::uint32_t StartOrder::run_of(RayStart const& start) {
  std::uint64_t const key =
      (std::uint64_t{start.number} << 32 | start.face) ^ (std::uint64_t{start.was_entering} << 63)
      ^ (std::uint64_t{start.through} << 62) ^ (static_cast<std::uint64_t>(start.kind) << 60);
  std::size_t const mask = table_.size() - 1;
  for (std::size_t at = (key * 0x9e3779b97f4a7c15) >> 32 & mask;; at = (at + 1) & mask) {
    if (table_[at] == 0) {
      runs_.push_back(start);
      ends_.push_back(0);
      table_[at] = static_cast<std::uint32_t>(runs_.size());
    }
    std::uint32_t const run = table_[at] - 1;
    if (runs_[run] == start) return run;
  }
}

void StartOrder::sort(RayStart const* starts, std::size_t count) {
  runs_.clear();
  ends_.clear();
  stretches_.clear();
  places_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == 0 || !(starts[k] == starts[k - 1])) stretches_.emplace_back();
    stretches_.back().end = static_cast<std::uint32_t>(k + 1);
  }
  table_.assign(std::bit_ceil(2 * stretches_.size() + 2), 0);
  std::uint32_t first = 0;
  for (Stretch& stretch : stretches_) {
    stretch.run = run_of(starts[first]);
    ends_[stretch.run] += stretch.end - first;
    first = stretch.end;
  }
  std::uint32_t at = 0;
  for (std::uint32_t& end : ends_) at += std::exchange(end, at);
  first = 0;
  for (Stretch const& stretch : stretches_) {
    std::uint32_t& end = ends_[stretch.run];
    for (; first < stretch.end; ++first) places_[end++] = first;
  }
}

void Hits::take_group(std::size_t k) {
  group[k] = groups.count() - 1;
  HitGroup const& own = groups[group[k]];
  if (own.crossings.empty()) {
    hit[k] = {};
    return;
  }
  SurfaceCrossing const& c = shown(own.crossings);
  hit[k] = {RayHit::Kind::Group, c.entering, c.toggles, c.entering, c.solid, c.primitive, c.face};
  if (own.crossings.size() == 1 && own.members.size() == 1) {
    hit[k].kind = RayHit::Kind::Single;
    hit[k].was_entering = own.members.front().was_entering;
  }
  t[k] = own.t;
  error[k] = own.error;
  point.set(k, own.point);
  point_error.set(k, own.point_error);
}

void World::Impl::find_alone(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                             Scratch& scratch, Hits& hits, std::size_t k) const {
  Alone found;
  Kind const kind = first_single(ray, from, mask, t_max, scratch, found);
  SurfaceCrossing const& c = found.crossing;
  // What is in contact with a surface that is left is part of a group.
  bool const touches = kind == Kind::Single && !c.entering && c.toggles && contacts.any()
                       && contacts.reach(c.solid) > 0;
  if (kind == Kind::Nothing) {
    hits.hit[k] = {};
  } else if (kind == Kind::Several || touches) {
    closest_group(ray, from, mask, t_max, scratch, hits.groups.add());
    hits.take_group(k);
  } else {
    hits.hit[k] = {RayHit::Kind::Single, c.entering, c.toggles, found.was_entering, c.solid,
                   c.primitive,          c.face};
    hits.t[k] = c.t;
    hits.error[k] = found.error;
    Vec3 point, point_error;
    set_point(ray.origin, ray.direction, c.t, found.error, point, point_error);
    hits.point.set(k, point);
    hits.point_error.set(k, point_error);
  }
}

namespace {

/// @return null: the ray starts in the open
Departure const* departure_of(RayStart const& start, Groups const* groups, Departure& out) {
  if (start.kind == RayStart::Kind::Nowhere) return nullptr;
  if (start.kind == RayStart::Kind::Surface)
    out.on.assign(1, {start.number, start.face, start.was_entering});
  else
    out.on = (*groups)[start.number].members;
  out.through = start.through;
  return &out;
}

/// Some of the rays of a batch that depart alike.
struct Packet {
  FanLines lines;
  double until[fan_width];
  std::uint32_t const* place = nullptr;

  double const* take(RayLines const& rays, double const* t_max, std::uint32_t const* places,
                     std::size_t count) {
    place = places;
    lines.count = count;
    lines.origin.take(rays.origin, place, count);
    lines.direction.take(rays.direction, place, count);
    lines.origin_error.take(rays.origin_error, place, count);
    lines.fill();
    if (t_max == nullptr) return nullptr;
    for (std::size_t i = 0; i < count; ++i) until[i] = t_max[place[i]];
    return until;
  }
};

/// Fewer rays than these that depart alike go each alone.
constexpr std::uint32_t least_packet = 2;

/// work(packet, departure, t_max) for the rays that depart alike, in packets; alone(place,
/// departure) where they are few.
template <class Work, class Single>
void each_packet(RayLines const& rays, double const* t_max, Scratch& scratch, Work const& work,
                 Single const& alone) {
  StartOrder& order = scratch.order;
  order.sort(rays.start, rays.count);
  Packet packet;
  std::uint32_t first = 0;
  for (std::uint32_t const end : order.ends()) {
    std::uint32_t const* const places = order.places().data();
    Departure const* const from =
        departure_of(rays.start[places[first]], rays.groups, scratch.departure);
    if (end - first < least_packet) {
      for (; first < end; ++first) alone(places[first], from);
      continue;
    }
    for (; first < end;) {
      std::size_t const some = std::min<std::size_t>(fan_width, end - first);
      work(packet, from, packet.take(rays, t_max, places + first, some));
      first += static_cast<std::uint32_t>(some);
    }
  }
}

} // namespace

void World::intersect(RayLines const& rays, std::uint8_t mask, double const* t_max,
                      Scratch& scratch, Hits& hits) const {
  hits.resize(rays.count);
  each_packet(
      rays, t_max, scratch,
      [&](Packet& packet, Departure const* from, double const* until) {
        impl_->closest_fan(packet.lines, packet.place, from, mask, until, scratch, hits);
      },
      [&](std::uint32_t k, Departure const* from) {
        double const end = t_max == nullptr ? everywhere : t_max[k];
        impl_->find_alone(rays.get(k), from, mask, end, scratch, hits, k);
      });
}

void World::occluded(RayLines const& rays, std::uint8_t mask, double const* t_max, Scratch& scratch,
                     std::uint8_t* blocked) const {
  each_packet(
      rays, t_max, scratch,
      [&](Packet& packet, Departure const* from, double const* until) {
        bool is[fan_width], clear[fan_width];
        impl_->occluded_fan(packet.lines, from, mask, until, scratch, is, clear);
        for (std::size_t i = 0; i < packet.lines.count; ++i) {
          if (!is[i] && !clear[i])
            is[i] = occluded(packet.lines.get(i), from, mask, until[i], scratch);
          blocked[packet.place[i]] = is[i];
        }
      },
      [&](std::uint32_t k, Departure const* from) {
        blocked[k] = occluded(rays.get(k), from, mask, t_max[k], scratch);
      });
}

} // namespace abbe::geometry
