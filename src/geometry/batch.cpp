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

/// The crossing of a group whose surface is shown.
SurfaceCrossing const& shown(HitGroup const& group) {
  auto const entered = std::find_if(group.crossings.begin(), group.crossings.end(),
                                    [](SurfaceCrossing const& c) { return c.entering; });
  return entered != group.crossings.end() ? *entered : group.crossings.front();
}

/// The last of the groups is what ray k meets, unless it is empty. One crossing of one primitive is
/// no group, however it was found.
void set_group(Hits& hits, std::size_t k) {
  hits.group[k] = hits.groups.count() - 1;
  HitGroup const& group = hits.groups[hits.group[k]];
  if (group.crossings.empty()) {
    hits.hit[k] = {};
    return;
  }
  SurfaceCrossing const& c = shown(group);
  hits.hit[k] = {RayHit::Kind::Group, c.entering, c.toggles, c.entering, c.solid,
                 c.primitive,         c.face};
  if (group.crossings.size() == 1 && group.members.size() == 1) {
    hits.hit[k].kind = RayHit::Kind::Single;
    hits.hit[k].was_entering = group.members.front().was_entering;
  }
  hits.t[k] = group.t;
  hits.error[k] = group.error;
  hits.point.set(k, group.point);
  hits.point_error.set(k, group.point_error);
}

void set_single(Hits& hits, std::size_t k, World::Impl::Alone const& found, Ray const& ray) {
  SurfaceCrossing const& c = found.crossing;
  hits.hit[k] = {RayHit::Kind::Single, c.entering, c.toggles, found.was_entering, c.solid,
                 c.primitive,          c.face};
  hits.t[k] = c.t;
  hits.error[k] = found.error;
  Vec3 point, point_error;
  set_point(ray.origin, ray.direction, c.t, found.error, point, point_error);
  hits.point.set(k, point);
  hits.point_error.set(k, point_error);
}

} // namespace

void World::intersect(RayLines const& rays, std::uint8_t mask, double const* t_max,
                      Scratch& scratch, Hits& hits) const {
  hits.resize(rays.count);
  auto const work = [&](Packet& packet, Departure const* from, double const* until) {
    FanHits& found = scratch.found;
    closest_fan(packet.lines, from, mask, until, scratch, found);
    for (std::size_t i = 0; i < packet.lines.count; ++i) {
      std::uint32_t const k = packet.place[i];
      FanHit const& own = found.hit[i];
      if (own.kind == FanHit::Kind::Nothing) {
        hits.hit[k] = {};
      } else if (own.kind == FanHit::Kind::Single) {
        hits.hit[k] = {RayHit::Kind::Single, own.entering, own.toggles, own.was_entering, own.solid,
                       own.primitive,        own.face};
        hits.t[k] = found.t[i];
        hits.error[k] = found.error[i];
        hits.point.set(k, found.point.get(i));
        hits.point_error.set(k, found.point_error.get(i));
      } else {
        double const end = until == nullptr ? everywhere : until[i];
        HitGroup& group = hits.groups.add();
        if (own.kind == FanHit::Kind::Pair)
          closest_pair(packet.lines.get(i), found.pair[i], mask, end, scratch, group);
        else
          closest_group(packet.lines.get(i), from, mask, end, scratch, group);
        set_group(hits, k);
      }
    }
  };
  auto const alone = [&](std::uint32_t k, Departure const* from) {
    Ray const ray = rays.get(k);
    double const end = t_max == nullptr ? everywhere : t_max[k];
    Impl::Alone found;
    Impl::Kind kind = impl_->first_single(ray, from, mask, end, scratch, found);
    // What is in contact with a surface that is left is part of a group.
    bool const leaves = !found.crossing.entering && found.crossing.toggles;
    if (kind == Impl::Kind::Single && leaves && impl_->contacts.any()
        && impl_->contacts.reach(found.crossing.solid) > 0)
      kind = Impl::Kind::Several;
    if (kind == Impl::Kind::Nothing) {
      hits.hit[k] = {};
    } else if (kind == Impl::Kind::Single) {
      set_single(hits, k, found, ray);
    } else {
      closest_group(ray, from, mask, end, scratch, hits.groups.add());
      set_group(hits, k);
    }
  };
  each_packet(rays, t_max, scratch, work, alone);
}

void World::occluded(RayLines const& rays, std::uint8_t mask, double const* t_max, Scratch& scratch,
                     std::uint8_t* blocked) const {
  each_packet(
      rays, t_max, scratch,
      [&](Packet& packet, Departure const* from, double const* until) {
        bool is[fan_width], clear[fan_width];
        occluded_fan(packet.lines, from, mask, until, scratch, is, clear);
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
