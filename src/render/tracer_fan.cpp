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

Beam Tracer::one_lane(Beam const& beam, int k) {
  Beam lane = beam;
  lane.lanes = 1;
  lane.channel += k;
  lane.slot += k;
  lane.throughput += k;
  lane.wave_band = lane.channel[0];
  return lane;
}

void Tracer::trace_lanes(FanRay const& fan, Beam const& beam, std::uint64_t& kind) {
  Arena::Scope const scope(arena_);
  auto* lines = arena_.take<FanLines>(1);
  auto* channel = arena_.take<std::uint16_t>(geometry::fan_width);
  auto* slot = arena_.take<std::uint32_t>(geometry::fan_width);
  auto* throughput = arena_.take<double>(geometry::fan_width);
  Beam some = beam;
  some.channel = channel;
  some.slot = slot;
  some.throughput = throughput;
  FanRay next = fan;
  next.lines = lines;
  std::size_t n = 0;
  for (int k = 0; k < beam.lanes; ++k) {
    if (!(beam.throughput[k] > stage_.adc_bailout)) {
      cut(one_lane(beam, k), 1);
      continue;
    }
    ++kind;
    lines->copy(n, *fan.lines, static_cast<std::size_t>(k));
    channel[n] = beam.channel[k];
    slot[n] = beam.slot[k];
    throughput[n] = beam.throughput[k];
    ++n;
  }
  lines->count = n;
  if (n > 0) lines->fill();
  some.lanes = static_cast<int>(n);
  if (n > 1 && recorder_ == nullptr) return trace_fan(next, some);
  for (int k = 0; k < some.lanes; ++k) trace(next.lane(k), one_lane(some, k));
}

void Tracer::trace_fan(FanRay const& fan, Beam const& beam) {
  auto const n = static_cast<std::size_t>(beam.lanes);
  if (fan.level >= stage_.max_trace_level) {
    for (int k = 0; k < beam.lanes; ++k) cut(one_lane(beam, k), 1);
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
      arrive(fan.lane(k), one_lane(beam, k), here, false);
      continue;
    }
    if (hit.kind == FanHit::Kind::Unclear) {
      --depth_;
      trace(fan.lane(k), one_lane(beam, k));
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
    lanes.lanes = static_cast<int>(count);
    lanes.channel += first;
    lanes.slot += first;
    lanes.throughput += first;
  }
  auto* face = arena_.take<FanInterface>(1);
  bool const plain = !stage_.has_priorities && !stage_.has_leaks;
  if (plain && count > 1 && fan_normals(*found, count, face->normal))
    return interact_fan(run, lanes, *found, *face, here);
  for (int k = 0; k < lanes.lanes; ++k) {
    found->write(static_cast<std::size_t>(k), here.hit);
    arrive(run.lane(k), one_lane(lanes, k), here, true);
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
    Vec3 const point = hits.point.get(k);
    Vec3 const normal = world.normal(surface.primitive, surface.face, point);
    if (!flat && normal != world.geometric_normal(surface.primitive, surface.face, point))
      return false;
    out.set(k, normal);
  }
  return true;
}

LaneSurface Tracer::shade_lane(PathRay const& ray, Beam const& lane, Frame& here,
                               FanInterface const& met, std::size_t k, LaneInterface& face,
                               InsideNode const* after, FanShadows& shadows) {
  face.normal = face.geometric = met.normal.get(k);
  face.cos_i = met.cos_i[k];
  face.reflectance = arena_.take<double>(1);
  face.transmittance = arena_.take<double>(1);
  face.total = arena_.take<bool>(1);
  face.reflectance[0] = met.reflectance[k];
  face.transmittance[0] = met.transmittance[k];
  face.total[0] = met.total[k] != 0;
  return Shader(*this, ray, lane, here, face, after, &shadows, k).shade();
}

void Tracer::interact_fan(FanRay const& fan, Beam const& incoming, FanHits const& hits,
                          FanInterface& met, Frame& here) {
  auto const n = static_cast<std::size_t>(incoming.lanes);
  Beam back = incoming, through = incoming;
  back.throughput = arena_.take<double>(n);
  through.throughput = arena_.take<double>(n);

  hits.write(0, here.hit);
  LaneInterface face;
  InsideNode const* const after = after_crossings(fan.inside, here.hit);
  face.before = medium_of(fan.inside);
  face.after = medium_of(after);
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  Medium const& beyond = stage_.media[static_cast<std::size_t>(face.after)];
  face.fresnel = before.fresnel || beyond.fresnel;
  bool const fades = fan.inside != after && before.fade_power != 0;
  auto const indices = [&](Medium const& medium, int number, double* out) {
    auto const of_wave = waves_.indices(number, incoming.wave);
    for (std::size_t k = 0; k < n; ++k)
      out[k] = medium.dispersive ? of_wave[incoming.channel[k]] : medium.index_d;
    for (std::size_t k = n; k % 4 != 0; ++k) out[k] = out[n - 1];
  };
  indices(before, face.before, met.n1);
  indices(beyond, face.after, met.n2);
  for (std::size_t k = n; k % 4 != 0; ++k) met.normal.set(k, met.normal.get(n - 1));
  meet_fan(fan.lines->direction, n, met);

  bool const bare = stage_.surfaces[hits.hit[0].primitive].bare();
  bool bends = false;
  auto* back_lines = arena_.take<FanLines>(1);
  auto* through_lines = arena_.take<FanLines>(1);
  back_lines->count = through_lines->count = n;
  back_lines->origin = through_lines->origin = hits.point;
  back_lines->origin_error = through_lines->origin_error = hits.point_error;
  back_lines->direction = met.mirrored;
  FanShadows shadows(*this, fan, hits, met.normal, after, here);
  for (std::size_t k = 0; k < n; ++k) {
    Arena::Scope const of_lane(arena_);
    auto const lane_number = static_cast<int>(k);
    Beam lane = one_lane(incoming, lane_number);
    double light = incoming.throughput[k];
    lane.throughput = &light;
    absorb(lane, before, hits.t[k]);
    if (fades) light *= distance_fade(before, lane.channel[0], hits.t[k]);
    bool const bent = met.n1[k] != met.n2[k];
    bends = bends || bent;
    through_lines->direction.set(k, bent ? met.refracted.get(k) : fan.lines->direction.get(k));
    if (bare) {
      bool const total = met.total[k] != 0;
      back.throughput[k] = light * (total ? 1 : face.fresnel ? met.reflectance[k] : 0);
      through.throughput[k] = light * (total ? 0 : face.fresnel ? met.transmittance[k] : 1);
    } else {
      PathRay const ray = fan.lane(lane_number);
      if (k > 0) hits.write(k, here.hit);
      LaneSurface const surface = shade_lane(ray, lane, here, met, k, face, after, shadows);
      if (surface.mirrors && surface.exponent != 1 && !face.total[0]) {
        reflect(ray, lane, here, face, surface);
        back.throughput[k] = 0;
      } else {
        back.throughput[k] = light * mirrored_weight(face, surface, 0, surface.passed[0] > 0);
      }
      through.throughput[k] = light * passed_weight(face, surface, 0);
    }
    if (met.below[k] < 0 && back.throughput[k] > stage_.adc_bailout) {
      face.normal = face.geometric = met.normal.get(k);
      back_lines->direction.set(k, mirrored_direction(fan.lines->direction.get(k), face));
    }
  }
  here.back.on = here.hit.members;
  here.back.through = false;
  trace_lanes({back_lines, &here.back, fan.inside, fan.level + 1, reflection_bit}, back,
              counts_.reflected);
  here.through.on = here.back.on;
  here.through.through = true;
  int const level = fan.level + (bends ? 1 : 0);
  trace_lanes({through_lines, &here.through, after, level, fan.mask}, through, counts_.refracted);
}

} // namespace abbe::render
