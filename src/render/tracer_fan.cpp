// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"
#include "render/fan_shadows.hpp"
#include "render/shader.hpp"

#include <algorithm>

/// Rays of neighbouring wavelengths together. Light is added per lane in the order in which trace()
/// would add it, so that the picture has the same bits.
namespace abbe::render {

using geometry::FanHit;
using geometry::FanHits;
using geometry::FanLines;

void Tracer::trace_lanes(FanRay const& fan, FanLines& all, Beam const& beam, std::uint64_t& kind) {
  int const each = fan.lanes_each, rays = beam.lanes / each;
  auto const goes_on = [&](int k) {
    return any_above(beam.throughput + k * each, each, stage_.adc_bailout);
  };
  int first_cut = 0;
  while (first_cut < rays && goes_on(first_cut)) ++first_cut;
  bool const together = recorder_ == nullptr;
  if (first_cut == rays && rays > 1 && together) {
    kind += static_cast<std::uint64_t>(rays);
    all.fill();
    return trace_fan(fan, beam);
  }
  Arena::Scope const scope(arena_);
  auto const room = geometry::fan_width * static_cast<std::size_t>(each);
  auto* lines = arena_.take<FanLines>(1);
  auto* channel = arena_.take<std::uint16_t>(room);
  auto* tooth = arena_.take<std::uint16_t>(room);
  auto* slot = arena_.take<std::uint32_t>(room);
  auto* throughput = arena_.take<double>(room);
  Beam some = beam;
  some.channel = channel;
  some.tooth = tooth;
  some.slot = slot;
  some.throughput = throughput;
  FanRay next = fan;
  next.lines = lines;
  std::size_t n = 0;
  int lanes = 0;
  for (int k = 0; k < rays; ++k) {
    Beam const own = beam.ray(k, each);
    if (k >= first_cut && !goes_on(k)) {
      cut(own, each);
      continue;
    }
    ++kind;
    lines->copy(n, all, static_cast<std::size_t>(k));
    std::copy_n(own.channel, each, channel + lanes);
    std::copy_n(own.tooth, each, tooth + lanes);
    std::copy_n(own.slot, each, slot + lanes);
    std::copy_n(own.throughput, each, throughput + lanes);
    lanes += each;
    ++n;
  }
  lines->count = n;
  if (n > 0) lines->fill();
  some.lanes = lanes;
  if (n > 1 && together) return trace_fan(next, some);
  for (int k = 0; k < static_cast<int>(n); ++k) trace(next.lane(k), some.ray(k, each));
}

void Tracer::trace_fan(FanRay const& fan, Beam const& beam) {
  std::size_t const n = fan.lines->count;
  int const each = fan.lanes_each;
  if (fan.level >= stage_.max_trace_level) {
    for (int k = 0; k < beam.lanes; k += each) cut(beam.ray(k / each, each), each);
    return;
  }
  ++depth_;
  Frame& here = frame(depth_, fan.lane(0), beam);
  Arena::Scope const scope(arena_);
  auto* hits = arena_.take<FanHits>(1);
  stage_.world->closest_fan(*fan.lines, fan.from, fan.mask, nullptr, *scratch_, *hits);
  std::size_t last = 0;
  for (std::size_t first = 0; first < n; first = last) {
    FanHit const& hit = hits->hit[first];
    last = first + 1;
    auto const k = static_cast<int>(first);
    if (hit.kind == FanHit::Kind::Nothing) {
      if (fan.inside)
        arrive(fan.lane(k), beam.ray(k, each), here, false);
      else
        add_background(fan.lines->direction.get(first), beam.ray(k, each));
      continue;
    }
    if (hit.kind == FanHit::Kind::Unclear) {
      --depth_;
      trace(fan.lane(k), beam.ray(k, each));
      ++depth_;
      continue;
    }
    while (last < n && hit == hits->hit[last]) ++last;
    interact_run(fan, beam, *hits, first, last - first, here);
  }
  --depth_;
}

void Tracer::interact_run(FanRay const& fan, Beam const& beam, FanHits const& hits,
                          std::size_t first, std::size_t count, Frame& here) {
  Arena::Scope const scope(arena_);
  FanRay run = fan;
  Beam lanes = beam;
  FanHits const* found = &hits;
  if (count < fan.lines->count) {
    auto* lines = arena_.take<FanLines>(1);
    auto* part = arena_.take<FanHits>(1);
    for (std::size_t i = 0; i < count; ++i) {
      lines->copy(i, *fan.lines, first + i);
      part->copy(i, hits, first + i);
    }
    lines->count = count;
    lines->fill();
    run.lines = lines;
    found = part;
    lanes = beam.from(static_cast<int>(first) * fan.lanes_each,
                      static_cast<int>(count) * fan.lanes_each);
  }
  auto* face = arena_.take<FanInterface>(1);
  bool const plain = !stage_.has_priorities && !stage_.has_leaks;
  if (plain && count > 1 && fan_normals(*found, count, face->normal)
      && interact_fan(run, lanes, *found, *face, here))
    return;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    found->write(static_cast<std::size_t>(k), here.hit);
    arrive(run.lane(k), lanes.ray(k, fan.lanes_each), here, true);
  }
}

bool Tracer::fan_normals(FanHits const& hits, std::size_t count, geometry::FanVectors& out) {
  FanHit const& surface = hits.hit[0];
  geometry::World const& world = *stage_.world;
  bool const flat = world.flat(surface.primitive, surface.face);
  for (std::size_t k = 0; k < count; ++k) {
    if (flat && k > 0) {
      out.set(k, out.get(0));
      continue;
    }
    auto const [smoothed, geometric] =
        world.normals(surface.primitive, surface.face, hits.point.get(k));
    if (smoothed != geometric) return false;
    out.set(k, geometric);
  }
  return true;
}

void Tracer::find_indices(Medium const& medium, int number, Beam const& beam, std::size_t rays,
                          double* out) {
  if (medium.dispersive && beam.monochromatic()) {
    auto const of_wave = waves_.indices(number, beam.wave);
    for (std::size_t k = 0; k < rays; ++k) out[k] = of_wave[beam.tooth[k]];
  } else {
    std::fill_n(out, rays, medium.index_d);
  }
  for (std::size_t k = rays; k % 4 != 0; ++k) out[k] = out[rays - 1];
}

namespace {

/// What a clear surface returns of each lane's light, and leaves of it.
void share_bare(FanInterface const& met, bool fresnel, std::size_t rays, int each, double* returns,
                double* light) {
  for (std::size_t k = 0; k < rays; ++k) {
    bool const total = met.total[k] != 0;
    double const back = total ? 1 : fresnel ? met.reflectance[k] : 0;
    double const on = total ? 0 : fresnel ? met.transmittance[k] : 1;
    for (int c = 0; c < each; ++c, ++returns, ++light) {
      *returns = *light * back;
      *light *= on;
    }
  }
}

/// What is known of each ray, for each of its lanes.
void spread(FanInterface const& met, std::size_t rays, int each, LaneInterface& face,
            Arena& arena) {
  std::size_t const lanes = rays * static_cast<std::size_t>(each);
  face.reflectance = arena.take<double>(lanes);
  face.transmittance = arena.take<double>(lanes);
  face.total = arena.take<bool>(lanes);
  for (std::size_t k = 0; k < rays; ++k) {
    auto const first = static_cast<int>(k) * each;
    std::fill_n(face.reflectance + first, each, met.reflectance[k]);
    std::fill_n(face.transmittance + first, each, met.transmittance[k]);
    std::fill_n(face.total + first, each, met.total[k] != 0);
  }
}

} // namespace

void Tracer::share_textured(FanRay const& fan, Beam& light, FanHits const& hits,
                            FanInterface const& met, LaneInterface& face, InsideNode const* after,
                            Frame& here, double* returns) {
  std::size_t const n = fan.lines->count;
  int const each = fan.lanes_each;
  auto const is_total = [](bool total) { return total; };
  bool const any_total = std::any_of(face.total, face.total + light.lanes, is_total);
  FanShadows shadows(*this, fan, hits, met.normal, after, here);
  Meeting const meeting{n,
                        &fan.lines->direction,
                        &hits.point,
                        &hits.point_error,
                        &met.normal,
                        &met.normal,
                        met.cos_i,
                        face.reflectance,
                        0};
  FanSurface const surface = shade_met(meeting, light, here, fan.inside, after, &shadows);
  for (std::size_t k = 0; k < n; ++k) {
    auto const first = static_cast<int>(k) * each;
    LaneSurface const own = surface.of(k, each);
    LaneInterface lanes = face;
    lanes.reflectance += first;
    lanes.transmittance += first;
    lanes.total += first;
    Beam const arriving = light.ray(static_cast<int>(k), each);
    bool const bent = own.mirrors && own.exponent != 1;
    if (bent && std::none_of(lanes.total, lanes.total + each, is_total)) {
      hits.write_place(k, here.hit);
      lanes.normal = lanes.geometric = met.normal.get(k);
      reflect(fan.lane(static_cast<int>(k)), arriving, here, lanes, own);
      std::fill_n(returns + first, each, 0.0);
    } else if (!own.mirrors && !face.fresnel && !any_total) {
      std::fill_n(returns + first, each, 0.0);
    } else {
      bool const passes = any_above(own.passed, each, 0);
      for (int c = 0; c < each; ++c)
        returns[first + c] = arriving.throughput[c] * own.mirrored_weight(lanes, c, passes);
    }
    for (int c = 0; c < each; ++c) arriving.throughput[c] *= own.passed_weight(lanes, c);
  }
}

bool Tracer::interact_fan(FanRay const& fan, Beam const& incoming, FanHits const& hits,
                          FanInterface& met, Frame& here) {
  std::size_t const n = fan.lines->count;
  hits.write(0, here.hit);
  LaneInterface face;
  InsideNode const* const after = after_crossings(fan.inside, here.hit);
  face.before = medium_of(fan.inside);
  face.after = medium_of(after);
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  Medium const& beyond = stage_.media[static_cast<std::size_t>(face.after)];
  bool const splits =
      !incoming.locked && face.before != face.after && (before.dispersive || beyond.dispersive);
  if (splits && !stage_.combs.empty()) return false;
  face.fresnel = before.fresnel || beyond.fresnel;
  bool const fades = fan.inside != after && before.fade_power != 0;
  for (std::size_t k = n; k % 4 != 0; ++k) met.normal.set(k, met.normal.get(n - 1));
  if (!splits) {
    find_indices(before, face.before, incoming, n, met.n1);
    find_indices(beyond, face.after, incoming, n, met.n2);
  }
  bool const unbent = !splits && std::equal(met.n1, met.n1 + n, met.n2);
  if (splits || unbent)
    meet_fan_unbent(fan.lines->direction, n, met);
  else
    meet_fan(fan.lines->direction, n, met);

  Beam back = incoming, through = incoming;
  back.throughput = arena_.take<double>(static_cast<std::size_t>(incoming.lanes));
  through.throughput = arena_.take<double>(static_cast<std::size_t>(incoming.lanes));
  std::copy_n(incoming.throughput, incoming.lanes, through.throughput);
  int const each = fan.lanes_each;
  absorb_fan(through, before, hits.t, each);
  for (std::size_t k = 0; fades && k < n; ++k) {
    Beam const own = through.ray(static_cast<int>(k), each);
    for (int c = 0; c < each; ++c)
      own.throughput[c] *= distance_fade(before, own.channel[c], hits.t[k]);
  }
  SplitWays ways;
  if (splits) ways = meet_split(fan, met, face);
  if (!splits && stage_.surfaces[hits.hit[0].primitive].bare()) {
    share_bare(met, face.fresnel, n, each, back.throughput, through.throughput);
  } else {
    if (!splits) spread(met, n, each, face, arena_);
    share_textured(fan, through, hits, met, face, after, here, back.throughput);
  }
  auto const lines_towards = [&](geometry::FanVectors const& direction) {
    auto* const lines = arena_.take<FanLines>(1);
    lines->count = n;
    lines->origin.take(hits.point, n);
    lines->origin_error.take(hits.point_error, n);
    lines->direction.take(direction, n);
    return lines;
  };
  if (any_but_zero(back.throughput, back.lanes)) {
    Arena::Scope const scope(arena_);
    FanLines* const lines = lines_towards(met.mirrored);
    for (std::size_t k = 0; k < n; ++k) {
      if (!(met.below[k] < 0)) continue;
      face.normal = face.geometric = met.normal.get(k);
      lines->direction.set(k, mirrored_direction(fan.lines->direction.get(k), face));
    }
    here.back.on = here.hit.members;
    here.back.through = false;
    trace_lanes({lines, &here.back, fan.inside, fan.level + 1, reflection_bit, each}, *lines, back,
                counts_.reflected);
  }
  if (!any_but_zero(through.throughput, through.lanes)) return true;
  here.through.on = here.hit.members;
  here.through.through = true;
  if (splits) {
    Medium const& governing = beyond.dispersive ? beyond : before;
    split_fan(fan, hits, through, ways, governing.tolerance_px, after, here);
    return true;
  }
  FanLines* const lines = lines_towards(fan.lines->direction);
  for (std::size_t k = 0; k < n; ++k)
    if (met.n1[k] != met.n2[k]) lines->direction.set(k, met.refracted.get(k));
  trace_lanes({lines, &here.through, after, fan.level + (unbent ? 0 : 1), fan.mask, each}, *lines,
              through, counts_.refracted);
  return true;
}

} // namespace abbe::render
