// SPDX-License-Identifier: MIT
#include "optics/refract.hpp"
#include "render/shader.hpp"

#include <algorithm>
#include <limits>

/// How the rays of a split go on, one way a dispersion mode.
namespace abbe::render {
namespace {

/// What a surface passes and mirrors, for the teeth of a comb.
LaneSurface for_teeth(LaneSurface const& surface, Beam const& beam, Beam const& teeth,
                      Arena& arena) {
  auto const m = static_cast<std::size_t>(teeth.lanes);
  LaneSurface out = surface;
  out.passed = arena.take<double>(m);
  out.mirrored = arena.take<double>(m);
  for (std::size_t i = 0; i < m; ++i) {
    int const k = std::clamp(teeth.channel[i] - beam.channel[0], 0, beam.lanes - 1);
    out.passed[i] = surface.passed[k];
    out.mirrored[i] = surface.mirrored[k];
  }
  return out;
}

} // namespace

Beam Tracer::unlit(Beam const& beam) {
  auto const n = static_cast<std::size_t>(beam.lanes);
  auto* slot = arena_.take<std::uint32_t>(n);
  std::fill_n(slot, n, film_.unused_slot(sample_of(beam)));
  Beam out = beam;
  out.slot = slot;
  return out;
}

Beam Tracer::combed(Beam const& beam, int comb, int rays) {
  int const each = waves_.teeth(comb), before = beam.lanes / rays;
  auto const lanes = static_cast<std::size_t>(each) * static_cast<std::size_t>(rays);
  auto* const channel = arena_.take<std::uint16_t>(lanes);
  auto* const tooth = arena_.take<std::uint16_t>(lanes);
  auto* const slot = arena_.take<std::uint32_t>(lanes);
  Beam out = beam;
  out.comb = comb;
  out.lanes = each * rays;
  out.channel = channel;
  out.tooth = tooth;
  out.slot = slot;
  out.throughput = arena_.take<double>(lanes);
  bool const apart = film_.has_control(comb);
  for (int ray = 0, at = 0; ray < rays; ++ray) {
    Beam const own = beam.ray(ray, before);
    std::size_t const sample = sample_of(own);
    auto const channels = waves_.channels(waves_.first_draw(comb), sample);
    int const first = waves_.first_tooth(comb, sample);
    for (int i = 0; i < each; ++i, ++at) {
      channel[at] = channels[static_cast<std::size_t>(i)];
      tooth[at] = static_cast<std::uint16_t>(first + i);
      slot[at] = apart ? film_.tooth_slot(sample, comb, i) : film_.channel_slot(sample, i);
      // Part of a polychromatic beam has the lanes of neighbouring channels.
      int const k = channel[at] - own.channel[0];
      out.throughput[at] = k >= 0 && k < before ? own.throughput[k] : 0;
    }
  }
  return out;
}

Beam Tracer::doubled(Beam const& beam, int comb) {
  auto const n = static_cast<std::size_t>(beam.lanes);
  std::size_t const sample = sample_of(beam);
  int const first_tooth = waves_.first_tooth(comb, sample);
  auto* channel = arena_.take<std::uint16_t>(2 * n);
  auto* tooth = arena_.take<std::uint16_t>(2 * n);
  auto* slot = arena_.take<std::uint32_t>(2 * n);
  Beam out = beam;
  out.comb = comb;
  out.lanes = 2 * beam.lanes;
  out.locked = false;
  out.throughput = arena_.take<double>(2 * n);
  auto const spreads = waves_.spreads(waves_.first_draw(comb), sample);
  for (std::size_t k = 0; k < n; ++k) {
    auto const& spread = spreads[beam.channel[k]];
    channel[2 * k] = static_cast<std::uint16_t>(spread.first);
    channel[2 * k + 1] = static_cast<std::uint16_t>(spread.second);
    for (std::size_t i : {2 * k, 2 * k + 1}) {
      tooth[i] = static_cast<std::uint16_t>(first_tooth + channel[i]);
      slot[i] = film_.doubled_slot(sample, comb, beam.channel[k], i % 2 == 1);
    }
    out.throughput[2 * k] = beam.throughput[k] * spread.first_weight;
    out.throughput[2 * k + 1] = beam.throughput[k] * spread.second_weight;
  }
  out.channel = channel;
  out.tooth = tooth; // the second draw has a wavelength a band
  out.slot = slot;
  return out;
}

std::uint32_t const* Tracer::picked_control_slots(Beam const& control) {
  auto const n = static_cast<std::size_t>(control.lanes);
  auto* slot = arena_.take<std::uint32_t>(n);
  for (std::size_t k = 0; k < n; ++k)
    slot[k] = stage_.spectral->is_line(control.channel[k])
                  ? control.slot[k]
                  : film_.picked_control_slot(film_.sample_of(control.slot[k]), control.comb,
                                              control.channel[k]);
  return slot;
}

std::uint32_t const* Tracer::control_slots(Beam const& control) {
  auto* const slot = arena_.take<std::uint32_t>(static_cast<std::size_t>(control.lanes));
  for (int k = 0; k < control.lanes; ++k)
    slot[k] =
        film_.control_slot(film_.sample_of(control.slot[k]), control.comb, control.channel[k]);
  return slot;
}

void Tracer::meet_comb(PathRay const& ray, Beam const& beam, Frame& frame,
                       LaneInterface const& face, InsideNode const* after) {
  Arena::Scope const scope(arena_);
  Beam control = beam;
  control.control = true;
  control.comb = face.comb;
  LaneInterface flat = face;
  find_interface(control, ray.line.direction, flat);
  // The surface's own light is added here, once.
  LaneSurface const surface = shade(ray, control, frame, flat, after);

  Beam teeth = beam;
  LaneInterface own = face;
  LaneSurface passing = surface;
  if (!face.doubles) {
    teeth = combed(beam, face.comb, 1);
    find_interface(teeth, ray.line.direction, own);
  }
  if (surface.explicit_reflection) // it may mirror by its Fresnel reflectance
    passing = shade(ray, unlit(teeth), frame, own, after);
  else if (!face.doubles)
    passing = for_teeth(surface, beam, teeth, arena_);
  reflect(ray, teeth, frame, own, passing);
  transmit(ray, teeth, frame, own, passing, after);

  if (!film_.has_control(face.comb)) return;
  control.slot = control_slots(control);
  reflect(ray, control, frame, flat, surface);
  transmit(ray, control, frame, flat, surface, after);
}

void Tracer::split(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                   InsideNode const* after) {
  if (!beam.monochromatic()) ++counts_.splits;
  if (face.doubles) return split_doubled(ray, beam, frame, face, after);
  Arena::Scope const scope(arena_);
  auto const n = static_cast<std::size_t>(beam.lanes);
  SplitWays const ways{arena_.take<double>(n), arena_.take<double>(n), arena_.take<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    Vec3 const way = optics::refracted(face.per_lane[k], ray.line.direction, face.normal);
    ways.x[k] = way.x;
    ways.y[k] = way.y;
    ways.z[k] = way.z;
  }
  auto* const places = arena_.take<geometry::FanVectors>(2);
  places[0].set(0, frame.hit.point);
  places[1].set(0, frame.hit.point_error);
  SplitStart const start{places, places + 1,    0,       beam.lanes, &frame.through,
                         after,  ray.level + 1, ray.mask};
  Beam apart = beam;
  apart.wave = face.split_wave;
  apart.locked = true;
  double const tolerance_px =
      stage_.media[static_cast<std::size_t>(face.split_medium)].tolerance_px;
  if (face.picks)
    send_picked(start, apart, ways);
  else if (face.comb == no_comb && tolerance_px > 0)
    split_adaptively(start, apart, ways, tolerance_px);
  else
    send_apart(start, apart, ways);
}

void Tracer::send_apart(SplitStart const& start, Beam const& beam, SplitWays const& ways) {
  Arena::Scope const scope(arena_);
  constexpr int width = geometry::fan_width;
  auto* lines = arena_.take<geometry::FanLines>(1);
  for (int first = 0; first < beam.lanes; first += width) {
    Beam const some = beam.from(first, std::min(width, beam.lanes - first));
    for (int k = 0; k < some.lanes; ++k) {
      auto const at = static_cast<std::size_t>(k);
      std::size_t const place = start.place(first + k);
      lines->origin.set(at, start.points->get(place));
      lines->origin_error.set(at, start.errors->get(place));
      lines->direction.set(at, ways.get(first + k));
    }
    lines->count = static_cast<std::size_t>(some.lanes);
    trace_lanes({lines, start.from, start.inside, start.level, start.mask}, *lines, some,
                counts_.monochromatic);
  }
}

void Tracer::split_doubled(PathRay const& ray, Beam const& beam, Frame& frame,
                           LaneInterface const& face, InsideNode const* after) {
  bool const first = beam.comb == no_comb;
  for (int k = 0; k < beam.lanes; ++k) {
    Beam lane = beam.lane(k);
    if (!(lane.throughput[0] > stage_.adc_bailout)) {
      cut(lane, 1);
      continue;
    }
    Arena::Scope const scope(arena_);
    lane.wave = face.split_wave;
    lane.locked = true;
    if (first) {
      lane.wave_tooth += waves_.first_tooth(face.comb, sample_of(beam));
      lane = doubled(lane, face.comb);
    }
    PathRay const next{{frame.hit.point,
                        optics::refracted(face.per_lane[k], ray.line.direction, face.normal),
                        frame.hit.point_error},
                       &frame.through,
                       after,
                       ray.level + 1,
                       ray.mask};
    ++counts_.monochromatic;
    trace(next, lane);
  }
}

void Tracer::send_picked(SplitStart const& start, Beam const& beam, SplitWays const& ways) {
  Arena::Scope const scope(arena_);
  int const each = start.lanes_each, rays = beam.lanes / each;
  // Emission lines are few, and each is all there is of its light.
  int const first_line = waves_.drawn_teeth(beam.comb), kept = 1 + each - first_line;
  auto const n = static_cast<std::size_t>(kept) * static_cast<std::size_t>(rays);
  auto* const channel = arena_.take<std::uint16_t>(n);
  auto* const tooth = arena_.take<std::uint16_t>(n);
  auto* const slot = arena_.take<std::uint32_t>(n);
  Beam some = beam;
  some.channel = channel;
  some.tooth = tooth;
  some.slot = slot;
  some.throughput = arena_.take<double>(n);
  some.lanes = 0;
  SplitWays const on{arena_.take<double>(n), arena_.take<double>(n), arena_.take<double>(n)};
  auto const follow = [&](int lane, double weight, std::uint32_t to) {
    int const at = some.lanes++;
    channel[at] = beam.channel[lane];
    tooth[at] = beam.tooth[lane];
    slot[at] = to;
    some.throughput[at] = beam.throughput[lane] * weight;
    on.x[at] = ways.x[lane];
    on.y[at] = ways.y[lane];
    on.z[at] = ways.z[lane];
  };
  for (int ray = 0; ray < rays; ++ray) {
    int const first = ray * each;
    std::size_t const sample = sample_of(beam.from(first, 1));
    auto const pick = waves_.pick(beam.comb, sample);
    follow(first + pick.tooth, pick.weight, film_.picked_slot(sample, beam.comb, pick.tooth));
    for (int k = first + first_line; k < first + each; ++k) follow(k, 1, beam.slot[k]);
  }
  SplitStart of_each = start;
  of_each.lanes_each = kept;
  send_apart(of_each, some, on);
}

/// The rays of one adaptive split: lanes at the ends of a range go alone, and when their routes
/// agree those between go together, on the route of the middle one.
struct Tracer::AdaptiveSplit {
  Tracer& tracer;
  SplitStart const& start;
  Beam const& beam;
  SplitWays const& ways;
  double tolerance_px;

  /// Lanes on the way of one of them.
  Beam together(int first, int count, int middle) const {
    Beam out = beam.from(first, count);
    out.wave_tooth = beam.tooth[middle];
    return out;
  }

  Route& alone(int k, std::size_t number) {
    while (tracer.routes_.size() <= number) tracer.routes_.emplace_back();
    Route& route = tracer.routes_[number];
    route.start(beam.throughput[k]);
    Tracer::Watch const watch(tracer, route);
    ++tracer.counts_.monochromatic;
    tracer.trace(start.towards(ways.get(k)), together(k, 1, k));
    return route;
  }

  void between(int first, Route const& from, int last, Route const& to, std::size_t number) {
    int const inner = last - first - 1;
    if (inner < 1) return;
    int const middle = first + (last - first) / 2;
    double const steps =
        from.apart_px(to, tracer.footprint_, !tracer.stage_.sky_pigments.empty()) / tolerance_px;
    if (steps <= 1) {
      ++tracer.counts_.monochromatic;
      return tracer.trace(start.towards(ways.get(middle)), together(first + 1, inner, middle));
    }
    // Each would go alone; or a few, between which an edge lies.
    bool const known = steps < std::numeric_limits<double>::infinity();
    if (known ? steps > inner : inner <= few_lanes)
      return tracer.send_apart(start, beam.from(first + 1, inner), ways.from(first + 1));
    Route const& here = alone(middle, number);
    between(first, from, middle, here, number + 1);
    between(middle, here, last, to, number + 1);
  }
  /// Of these together, what each takes is less than what finding those to be spared would.
  static constexpr int few_lanes = 6;
};

void Tracer::split_adaptively(SplitStart const& start, Beam const& beam, SplitWays const& ways,
                              double tolerance_px) {
  AdaptiveSplit split{*this, start, beam, ways, tolerance_px};
  auto const carries = [&](int k) { return beam.throughput[k] > stage_.adc_bailout; };
  for (int first = 0; first < beam.lanes;) {
    if (!carries(first)) {
      cut(beam.lane(first), 1);
      ++first;
      continue;
    }
    // Wavelengths rise within a range: lines come after the bands.
    int last = first;
    while (last + 1 < beam.lanes && carries(last + 1)
           && stage_.lambda_nm(beam.channel[last]) < stage_.lambda_nm(beam.channel[last + 1]))
      ++last;
    Route const& from = split.alone(first, 0);
    if (last > first) split.between(first, from, last, split.alone(last, 1), 2);
    first = last + 1;
  }
}

} // namespace abbe::render
