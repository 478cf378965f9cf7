// SPDX-License-Identifier: MIT
#include "render/fan_shadows.hpp"

#include "render/fan_interface.hpp"
#include "render/shader.hpp"

#include <algorithm>

namespace abbe::render {

using geometry::FanHit;
using geometry::FanHits;
using geometry::FanLines;

FanShadows::FanShadows(Tracer& tracer, FanRay const& fan, geometry::FanHits const& hits,
                       geometry::FanVectors const& normals, InsideNode const* after,
                       Tracer::Frame& frame, Beam const& beam)
    : tracer_(tracer),
      fan_(fan),
      hits_(hits),
      normals_(normals),
      after_(after),
      frame_(frame),
      beam_(beam),
      ways_(tracer.arena_.take<Ways>(tracer.stage_.lights.size())) {
  auto const lanes = static_cast<std::size_t>(beam.lanes);
  for (std::size_t i = 0; i < tracer.stage_.lights.size(); ++i) {
    ways_[i].aimed = ways_[i].known = false;
    ways_[i].left = tracer.stage_.has_filter_shadows ? tracer.arena_.take<double>(lanes) : nullptr;
  }
}

FanShadows::Ways& FanShadows::aimed(CompiledLight const& light) {
  Ways& ways = ways_[&light - tracer_.stage_.lights.data()];
  if (ways.aimed) return ways;
  ways.aimed = true;
  render::aim(light, hits_.point, normals_, fan_.lines->count, ways.aim);
  return ways;
}

FanShadows::Way const* FanShadows::ways(CompiledLight const& light) {
  Ways& ways = aimed(light);
  if (!ways.known) find(ways);
  return ways.way;
}

double const* FanShadows::left(CompiledLight const& light, std::size_t lane) const {
  Ways const& ways = ways_[&light - tracer_.stage_.lights.data()];
  return ways.left + lane * static_cast<std::size_t>(fan_.lanes_each);
}

void FanShadows::find(Ways& out) {
  out.known = true;
  std::size_t const n = fan_.lines->count;
  std::fill_n(out.way, n, Way::Unknown);
  Arena::Scope const scope(tracer_.arena_);
  auto* lines = tracer_.arena_.take<geometry::FanLines>(1);
  bool through = false;
  for (std::size_t k = 0; k < n; ++k) {
    if ((out.aim.comes >> k & 1) == 0 || !(out.aim.distance[k] > 0)) return;
    bool const beyond = out.aim.cosine[k] < 0;
    if (k > 0 && beyond != through) return; // the lamp is in the surface's plane
    through = beyond;
  }
  lines->count = n;
  lines->origin.take(hits_.point, n);
  lines->origin_error.take(hits_.point_error, n);
  lines->direction.take(out.aim.direction, n);
  lines->fill();
  double const* const to_lamp = out.aim.distance;
  frame_.shadow.on = frame_.hit.members;
  frame_.shadow.through = through;
  Stage const& stage = tracer_.stage_;
  InsideNode const* const inside = through ? after_ : fan_.inside;
  bool blocked[geometry::fan_width], clear[geometry::fan_width];
  stage.world->occluded_fan(*lines, &frame_.shadow, opaque_shadow_bit, to_lamp, *tracer_.scratch_,
                            blocked, clear);
  for (std::size_t k = 0; k < n; ++k) {
    if (blocked[k]) out.way[k] = Way::Blocked;
    if (clear[k] && !stage.has_filter_shadows) out.way[k] = Way::Free;
  }
  if (!stage.has_filter_shadows || std::none_of(clear, clear + n, [](bool is) { return is; }))
    return;
  auto* hits = tracer_.arena_.take<geometry::FanHits>(1);
  stage.world->closest_fan(*lines, &frame_.shadow, filter_shadow_bit, to_lamp, *tracer_.scratch_,
                           *hits);
  bool filters = false;
  for (std::size_t k = 0; k < n; ++k) {
    if (!clear[k]) continue;
    bool const free = !inside && hits->hit[k].kind == FanHit::Kind::Nothing;
    if (free) out.way[k] = Way::Free;
    filters = filters || !free;
  }
  bool const plain = !stage.has_priorities && !stage.has_leaks && tracer_.route_ == nullptr;
  if (!filters || !plain) return;
  Filtered all{lines, &frame_.shadow, inside, out.aim.distance, tracer_.arena_.take<std::size_t>(n),
               beam_};
  for (std::size_t k = 0; k < n; ++k) all.place[k] = k;
  all.light.throughput = tracer_.arena_.take<double>(static_cast<std::size_t>(beam_.lanes));
  std::fill_n(all.light.throughput, beam_.lanes, 1.0);
  auto* own_hits = tracer_.arena_.take<geometry::FanHits>(1);
  auto const is_filtered = [&](std::size_t k) { return clear[k] && out.way[k] != Way::Free; };
  filter(some(all, is_filtered, hits, own_hits), *own_hits, out);
}

FanShadows::Filtered FanShadows::take(Filtered const& like, std::size_t count) {
  Arena& arena = tracer_.arena_;
  auto const lanes = count * static_cast<std::size_t>(fan_.lanes_each);
  Filtered out{arena.take<FanLines>(1),        like.from, like.inside, arena.take<double>(count),
               arena.take<std::size_t>(count), like.light};
  out.lines->count = count;
  out.light.lanes = static_cast<int>(lanes);
  out.light.throughput = arena.take<double>(lanes);
  return out;
}

template <class Wanted>
FanShadows::Filtered FanShadows::some(Filtered const& rays, Wanted const& wanted,
                                      FanHits const* hits, FanHits* hits_out) {
  std::size_t const n = rays.lines->count;
  int const each = fan_.lanes_each;
  Filtered out = take(rays, n);
  auto const lanes = static_cast<std::size_t>(rays.light.lanes);
  auto* const channel = tracer_.arena_.take<std::uint16_t>(lanes);
  auto* const tooth = tracer_.arena_.take<std::uint16_t>(lanes);
  out.light.channel = channel;
  out.light.tooth = tooth;
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!wanted(k)) continue;
    out.lines->copy(count, *rays.lines, k);
    out.rest[count] = rays.rest[k];
    out.place[count] = rays.place[k];
    if (hits != nullptr) hits_out->copy(count, *hits, k);
    auto const from = static_cast<int>(k) * each, to = static_cast<int>(count) * each;
    std::copy_n(rays.light.channel + from, each, channel + to);
    std::copy_n(rays.light.tooth + from, each, tooth + to);
    std::copy_n(rays.light.throughput + from, each, out.light.throughput + to);
    ++count;
  }
  out.lines->count = count;
  out.light.lanes = static_cast<int>(count) * each;
  if (count > 0) out.lines->fill();
  return out;
}

void FanShadows::filter(Filtered const& rays, FanHits& hits, Ways& out) {
  std::size_t const n = rays.lines->count;
  FanRay const fan{rays.lines, rays.from, rays.inside, 0, filter_shadow_bit, fan_.lanes_each};
  ++tracer_.depth_;
  Tracer::Frame& frame = tracer_.frame(tracer_.depth_, fan.lane(0), rays.light);
  Tracer::FanGroups found;
  Tracer::FanGroups const* const groups =
      tracer_.find_groups(fan, rays.rest, hits, frame, found) ? &found : nullptr;
  for (std::size_t k = 0; k < n; ++k) // what the lamp lies on is not in its way
    if (!(hits.t[k] + hits.error[k] < rays.rest[k])) hits.hit[k].kind = FanHit::Kind::Nothing;
  std::size_t last = 0;
  for (std::size_t first = 0; first < n; first = last) {
    for (last = first + 1; last < n && Tracer::same_hit(hits, groups, first, last);) ++last;
    Arena::Scope const scope(tracer_.arena_);
    auto* run_hits = tracer_.arena_.take<FanHits>(1);
    auto const in_run = [&](std::size_t k) { return k >= first && k < last; };
    Filtered const run = some(rays, in_run, &hits, run_hits);
    if (hits.hit[first].kind == FanHit::Kind::Nothing) {
      arrive(run, out);
      continue;
    }
    if (groups != nullptr && (*groups)[first] != nullptr)
      frame.hit = *(*groups)[first];
    else
      hits.write(first, frame.hit);
    filter_behind(run, *run_hits, frame, out);
  }
  --tracer_.depth_;
}

void FanShadows::arrive(Filtered const& rays, Ways& out) {
  int const each = fan_.lanes_each;
  Medium const& medium =
      tracer_.stage_
          .media[static_cast<std::size_t>(tracer_.medium_of(rays.inside))]; // the lamp stands in it
  Beam light = rays.light;
  tracer_.absorb_fan(light, medium, rays.rest, each);
  for (std::size_t k = 0; k < rays.lines->count; ++k) {
    double* const left = light.throughput + static_cast<int>(k) * each;
    for (int c = 0; c < each; ++c)
      left[c] *= shadow_fade(medium, light.channel[static_cast<int>(k) * each + c], rays.rest[k]);
    std::size_t const place = rays.place[k];
    std::copy_n(left, each, out.left + static_cast<int>(place) * each);
    out.way[place] = any_above(left, each, 0) ? Way::Filtered : Way::Blocked;
  }
}

void FanShadows::filter_behind(Filtered const& rays, FanHits const& hits, Tracer::Frame& frame,
                               Ways& out) {
  Stage const& stage = tracer_.stage_;
  int const each = fan_.lanes_each;
  std::size_t const n = rays.lines->count;
  Beam light = rays.light;
  Medium const& medium = stage.media[static_cast<std::size_t>(tracer_.medium_of(rays.inside))];
  InsideNode const* const next = tracer_.after_crossings(rays.inside, frame.hit);
  tracer_.absorb_fan(light, medium, hits.t, each);
  bool const leaves = tracer_.medium_of(next) != tracer_.medium_of(rays.inside);
  bool lit[geometry::fan_width], there[geometry::fan_width];
  for (std::size_t k = 0; k < n; ++k) {
    auto const first = static_cast<int>(k) * each;
    double* const left = light.throughput + first;
    for (int c = 0; leaves && c < each; ++c)
      left[c] *= shadow_fade(medium, light.channel[first + c], hits.t[k]);
    for (auto const& crossing : frame.hit.crossings)
      stage.reader().tint(
          frame.hit, crossing, stage.caustics(crossing.solid),
          {hits.point.get(k), rays.lines->direction.get(k), light.channel + first, each, left},
          tracer_.arena_);
    lit[k] = any_above(left, each, 0);
    rays.rest[k] -= hits.t[k];
    there[k] = !(rays.rest[k] > 0);
    if (!lit[k]) out.way[rays.place[k]] = Way::Blocked;
    if (there[k]) rays.rest[k] = std::max(rays.rest[k], 0.0);
  }
  Filtered behind = rays;
  behind.light = light;
  behind.inside = next;
  behind.from = &frame.through;
  frame.through.on = frame.hit.members;
  frame.through.through = true;
  arrive(some(
             behind, [&](std::size_t k) { return lit[k] && there[k]; }, nullptr, nullptr),
         out);
  auto* const points = tracer_.arena_.take<FanHits>(1);
  Filtered const onwards = some(
      behind, [&](std::size_t k) { return lit[k] && !there[k]; }, &hits, points);
  if (onwards.lines->count > 0) {
    onwards.lines->origin.take(points->point, onwards.lines->count);
    onwards.lines->origin_error.take(points->point_error, onwards.lines->count);
    onwards.lines->fill();
    auto* const met = tracer_.arena_.take<FanHits>(1);
    stage.world->closest_fan(*onwards.lines, onwards.from, filter_shadow_bit, onwards.rest,
                             *tracer_.scratch_, *met);
    filter(onwards, *met, out);
  }
}

} // namespace abbe::render
