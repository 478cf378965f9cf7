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
  FanGroups found;
  FanGroups const* const groups = find_groups(fan, nullptr, *hits, here, found) ? &found : nullptr;
  std::size_t last = 0;
  for (std::size_t first = 0; first < n; first = last) {
    last = first + 1;
    auto const k = static_cast<int>(first);
    if (hits->hit[first].kind == FanHit::Kind::Nothing) {
      if (fan.inside)
        arrive(fan.lane(k), beam.ray(k, each), here, false);
      else
        add_background(fan.lines->direction.get(first), beam.ray(k, each));
      continue;
    }
    while (last < n && same_hit(*hits, groups, first, last)) ++last;
    interact_run(fan, beam, *hits, groups, first, last - first, here);
  }
  --depth_;
}

void Tracer::interact_run(FanRay const& fan, Beam const& beam, FanHits const& hits,
                          FanGroups const* groups, std::size_t first, std::size_t count,
                          Frame& here) {
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
      && interact_fan(run, lanes, *found, groups ? (*groups)[first] : nullptr, *face, here))
    return;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    auto const place = static_cast<std::size_t>(k);
    if (groups != nullptr && (*groups)[first + place] != nullptr)
      here.hit = *(*groups)[first + place];
    else
      found->write(place, here.hit);
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
    if (beam.wave == band_means)
      for (std::size_t k = 0; k < rays; ++k) out[k] = medium.index[beam.tooth[k]];
    else
      for (std::size_t k = 0; k < rays; ++k)
        out[k] = waves_.index(number, beam.wave, beam.tooth[k]);
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
  double *const reflectance = face.reflectance, *const transmittance = face.transmittance;
  bool* const total = face.total;
  int lane = 0;
  for (std::size_t k = 0; k < rays; ++k)
    for (int const end = lane + each; lane < end; ++lane) {
      reflectance[lane] = met.reflectance[k];
      transmittance[lane] = met.transmittance[k];
      total[lane] = met.total[k] != 0;
    }
}

} // namespace

double* Tracer::share_textured(FanMet const& at, Beam& light, LaneInterface& face,
                               double* returns) {
  auto const& [fan, hits, met, after, here] = at;
  std::size_t const n = fan.lines->count;
  int const each = fan.lanes_each;
  auto const is_total = [](bool total) { return total; };
  bool const any_total = std::any_of(face.total, face.total + light.lanes, is_total);
  FanShadows shadows(*this, fan, hits, met.normal, after, here, light);
  Meeting const meeting{n,           &fan.lines->direction, &hits.point, &hits.point_error,
                        &met.normal, &met.normal,           met.cos_i,   face.reflectance,
                        face.carrier};
  FanSurface const surface = shade_met(meeting, light, here, fan.inside, after, &shadows);
  double* const throughput = light.throughput;
  bool const any_mirrors =
      std::find(surface.mirrors, surface.mirrors + n, true) != surface.mirrors + n;
  if (!any_mirrors && !face.fresnel && !any_total) {
    std::fill_n(returns, light.lanes, 0.0);
    for (int k = 0; k < light.lanes; ++k) throughput[k] *= surface.passed[k];
    return surface.passed;
  }
  for (std::size_t k = 0; k < n; ++k) {
    auto const first = static_cast<int>(k) * each;
    LaneSurface const own = surface.of(k, each);
    bool const bent = own.mirrors && own.exponent != 1;
    if (bent && std::none_of(face.total + first, face.total + first + each, is_total)) {
      LaneInterface lanes = face;
      lanes.reflectance += first;
      lanes.transmittance += first;
      lanes.total += first;
      hits.write_place(k, here.hit);
      lanes.normal = lanes.geometric = met.normal.get(k);
      reflect(fan.lane(static_cast<int>(k)), light.ray(static_cast<int>(k), each), here, lanes,
              own);
      std::fill_n(returns + first, each, 0.0);
    } else {
      bool const passes = any_above(own.passed, each, 0);
      for (int c = 0; c < each; ++c)
        returns[first + c] = throughput[first + c] * own.mirrored_weight(face, c, passes, first);
    }
    for (int c = 0; c < each; ++c) throughput[first + c] *= own.passed_weight(face, c, first);
  }
  return surface.passed;
}

void Tracer::find_split(FanRay const& fan, Beam const& incoming, InsideNode const* after,
                        LaneInterface& face) {
  face.before = medium_of(fan.inside);
  face.after = medium_of(after);
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  Medium const& beyond = stage_.media[static_cast<std::size_t>(face.after)];
  face.fresnel = before.fresnel || beyond.fresnel;
  face.split_medium = beyond.dispersive ? face.after : face.before;
  Medium const& governing = beyond.dispersive ? beyond : before;
  bool const disperses = !incoming.locked && face.before != face.after && governing.dispersive;
  face.comb = incoming.comb != no_comb ? incoming.comb : governing.comb;
  face.splits = disperses && !(incoming.control && face.comb != no_comb);
  face.split_wave = band_means;
  if (!disperses || face.comb == no_comb) return;
  auto const& comb = stage_.combs[static_cast<std::size_t>(face.comb)];
  face.doubles = face.splits && comb.follow == optics::Comb::Follow::Doubled;
  face.picks = comb.picks_one();
  face.split_wave = waves_.first_draw(face.comb);
}

bool Tracer::interact_fan(FanRay const& fan, Beam const& incoming, FanHits const& hits,
                          geometry::HitGroup const* group, FanInterface& met, Frame& here) {
  std::size_t const n = fan.lines->count;
  if (group != nullptr)
    here.hit = *group;
  else
    hits.write(0, here.hit);
  LaneInterface face;
  face.carrier = carrier_of(here.hit.crossings);
  InsideNode const* const after = after_crossings(fan.inside, here.hit);
  find_split(fan, incoming, after, face);
  bool const meets_comb = face.splits && face.comb != no_comb && incoming.comb == no_comb;
  auto const& crossings = here.hit.crossings;
  auto const mirrors = [&](auto const& crossing) {
    return stage_.textures.mirrors(stage_.textures.surfaces[crossing.primitive]);
  };
  if (face.doubles || (meets_comb && std::any_of(crossings.begin(), crossings.end(), mirrors)))
    return false;
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  Medium const& beyond = stage_.media[static_cast<std::size_t>(face.after)];
  for (std::size_t k = n; k % 4 != 0; ++k) met.normal.set(k, met.normal.get(n - 1));
  bool const alone = face.splits && !meets_comb; // each wavelength has an index of its own
  if (!alone) {
    find_indices(before, face.before, incoming, n, met.n1);
    find_indices(beyond, face.after, incoming, n, met.n2);
  }
  if (alone || std::equal(met.n1, met.n1 + n, met.n2))
    meet_fan_unbent(fan.lines->direction, n, met);
  else
    meet_fan(fan.lines->direction, n, met);

  int const each = fan.lanes_each;
  Beam through = incoming;
  through.throughput = arena_.take<double>(static_cast<std::size_t>(incoming.lanes));
  std::copy_n(incoming.throughput, incoming.lanes, through.throughput);
  absorb_fan(through, before, hits.t, each);
  bool const fades = fan.inside != after && before.fade_distance != 0;
  for (std::size_t k = 0; fades && k < n; ++k) {
    Beam const own = through.ray(static_cast<int>(k), each);
    for (int c = 0; c < each; ++c)
      own.throughput[c] *= distance_fade(before, own.channel[c], hits.t[k]);
  }
  FanMet const meeting{fan, hits, met, after, here};
  if (meets_comb)
    meet_comb_fan(meeting, through, face);
  else
    share_and_go_on(meeting, through, face);
  return true;
}

void Tracer::share_and_go_on(FanMet const& at, Beam& through, LaneInterface& face) {
  Beam back = through;
  back.throughput = arena_.take<double>(static_cast<std::size_t>(through.lanes));
  SplitWays const ways = face.splits ? meet_split(at, through, face) : SplitWays{};
  share(at, through, face, back.throughput);
  go_on(at, back, through, face, ways);
}

double* Tracer::share(FanMet const& at, Beam& light, LaneInterface& face, double* returns) {
  std::size_t const n = at.fan.lines->count;
  auto const& crossings = at.here.hit.crossings;
  auto const bare = [&](auto const& crossing) {
    return stage_.textures.surfaces[crossing.primitive].bare();
  };
  if (!face.splits && std::all_of(crossings.begin(), crossings.end(), bare)) {
    share_bare(at.met, face.fresnel, n, at.fan.lanes_each, returns, light.throughput);
    return nullptr;
  }
  if (!face.splits) spread(at.met, n, at.fan.lanes_each, face, arena_);
  return share_textured(at, light, face, returns);
}

void Tracer::go_on(FanMet const& at, Beam const& back, Beam const& through, LaneInterface& face,
                   SplitWays const& ways) {
  auto const& [fan, met_hits, met, after, here] = at;
  FanHits const& hits = met_hits; // clang 14 lets no lambda have a structured binding
  std::size_t const n = fan.lines->count;
  int const each = fan.lanes_each;
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
  if (!any_but_zero(through.throughput, through.lanes)) return;
  here.through.on = here.hit.members;
  here.through.through = true;
  if (face.splits) return split_fan(at, through, face, ways);
  FanLines* const lines = lines_towards(fan.lines->direction);
  for (std::size_t k = 0; k < n; ++k)
    if (met.n1[k] != met.n2[k]) lines->direction.set(k, met.refracted.get(k));
  bool const unbent = std::equal(met.n1, met.n1 + n, met.n2);
  Beam passed = through;
  if (face.picks) passed.slot = picked_control_slots(passed);
  trace_lanes({lines, &here.through, after, fan.level + (unbent ? 0 : 1), fan.mask, each}, *lines,
              passed, counts_.refracted);
}

} // namespace abbe::render
