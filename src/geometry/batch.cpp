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
  places_.resize(count);
  run_.resize(count);
  table_.assign(std::bit_ceil(2 * count + 2), 0);
  for (std::size_t k = 0; k < count; ++k) {
    run_[k] = k > 0 && starts[k] == starts[k - 1] ? run_[k - 1] : run_of(starts[k]);
    ++ends_[run_[k]];
  }
  std::uint32_t at = 0;
  for (std::uint32_t& end : ends_) at += std::exchange(end, at);
  for (std::size_t k = 0; k < count; ++k) places_[ends_[run_[k]]++] = static_cast<std::uint32_t>(k);
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
    for (std::size_t i = 0; i < count; ++i) {
      lines.origin.set(i, rays.origin.get(place[i]));
      lines.direction.set(i, rays.direction.get(place[i]));
      lines.origin_error.set(i, rays.origin_error.get(place[i]));
    }
    lines.fill();
    if (t_max == nullptr) return nullptr;
    for (std::size_t i = 0; i < count; ++i) until[i] = t_max[place[i]];
    return until;
  }
};

/// work(packet, departure, t_max) for all rays, in packets of rays that depart alike.
template <class Work>
void each_packet(RayLines const& rays, double const* t_max, Scratch& scratch, Work const& work) {
  StartOrder& order = scratch.order;
  order.sort(rays.start, rays.count);
  Packet packet;
  std::uint32_t first = 0;
  for (std::uint32_t const end : order.ends()) {
    std::uint32_t const* const places = order.places().data();
    Departure const* const from =
        departure_of(rays.start[places[first]], rays.groups, scratch.departure);
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
      rays, t_max, scratch, [&](Packet& packet, Departure const* from, double const* until) {
        FanHits& found = scratch.found;
        closest_fan(packet.lines, from, mask, until, scratch, found);
        for (std::size_t i = 0; i < packet.lines.count; ++i) {
          std::uint32_t const k = packet.place[i];
          FanHit const& own = found.hit[i];
          RayHit& hit = hits.hit[k];
          if (own.kind == FanHit::Kind::Nothing) {
            hit = {};
            continue;
          }
          if (own.kind == FanHit::Kind::Single) {
            hit = {RayHit::Kind::Single, own.entering, own.toggles, own.was_entering, own.solid,
                   own.primitive,        own.face};
            hits.t[k] = found.t[i];
            hits.error[k] = found.error[i];
            hits.point.set(k, found.point.get(i));
            hits.point_error.set(k, found.point_error.get(i));
            continue;
          }
          std::uint32_t const number = hits.groups.count();
          HitGroup& group = hits.groups.add();
          double const end = until == nullptr ? everywhere : until[i];
          if (own.kind == FanHit::Kind::Pair) {
            closest_pair(packet.lines.get(i), found.pair[i], mask, end, scratch, group);
          } else if (!closest_group(packet.lines.get(i), from, mask, end, scratch, group)) {
            hit = {};
            continue;
          }
          auto const entered = std::find_if(group.crossings.begin(), group.crossings.end(),
                                            [](SurfaceCrossing const& c) { return c.entering; });
          SurfaceCrossing const& shown =
              entered != group.crossings.end() ? *entered : group.crossings.front();
          hit = {RayHit::Kind::Group, shown.entering,  shown.toggles, shown.entering,
                 shown.solid,         shown.primitive, shown.face};
          hits.group[k] = number;
          hits.t[k] = group.t;
          hits.error[k] = group.error;
          hits.point.set(k, group.point);
          hits.point_error.set(k, group.point_error);
        }
      });
}

void World::occluded(RayLines const& rays, std::uint8_t mask, double const* t_max, Scratch& scratch,
                     std::uint8_t* blocked) const {
  each_packet(rays, t_max, scratch,
              [&](Packet& packet, Departure const* from, double const* until) {
                bool is[fan_width], clear[fan_width];
                occluded_fan(packet.lines, from, mask, until, scratch, is, clear);
                for (std::size_t i = 0; i < packet.lines.count; ++i) {
                  if (!is[i] && !clear[i])
                    is[i] = occluded(packet.lines.get(i), from, mask, until[i], scratch);
                  blocked[packet.place[i]] = is[i];
                }
              });
}

} // namespace abbe::geometry
