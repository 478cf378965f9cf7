// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"
#include "render/tracer.hpp"

#include <algorithm>

/// Samples that enter dispersive glass next to each other: their rays of single wavelengths fill
/// fans together, sample by sample. What happens to each has the bits of Tracer::split().
namespace abbe::render {

SplitWays Tracer::meet_split(FanMet const& at, Beam const& beam, LaneInterface& face) {
  std::size_t const n = at.fan.lines->count;
  std::size_t const each = static_cast<std::size_t>(beam.lanes) / n;
  std::size_t const lanes = n * each + 3, whole = (each + 3) / 4 * 4; // written four at a time
  auto const values = [&](std::size_t count) { return arena_.take<double>(count); };
  double *const n1 = values(whole), *const n2 = values(whole);
  auto const take = [&](double* out, int medium, std::size_t sample) {
    auto const indices = waves_.indices(medium, face.split_wave, sample);
    std::copy_n(indices.begin(), each, out);
    for (std::size_t c = each; c < whole; ++c) out[c] = out[each - 1];
  };
  face.reflectance = values(lanes);
  face.transmittance = values(lanes);
  face.total = arena_.take<bool>(lanes);
  SplitWays const ways{values(lanes), values(lanes), values(lanes)};
  for (std::size_t k = 0; k < n; ++k) {
    if (k == 0 || face.comb != no_comb) { // a comb draws others for each sample
      std::size_t const sample = film_.sample_of(beam.slot[k * each]);
      take(n1, face.before, sample);
      take(n2, face.after, sample);
    }
    meet_lanes(at.fan.lines->direction.get(k), at.met.normal.get(k), at.met.cos_i[k],
               {n1, n2, each, face.reflectance + k * each, face.transmittance + k * each,
                face.total + k * each, ways.x + k * each, ways.y + k * each, ways.z + k * each});
  }
  return ways;
}

void Tracer::split_fan(FanMet const& at, Beam const& passed, LaneInterface const& face,
                       SplitWays const& ways) {
  int const each = at.fan.lanes_each, rays = passed.lanes / each;
  double const tolerance_px =
      face.comb != no_comb ? 0
                           : stage_.media[static_cast<std::size_t>(face.split_medium)].tolerance_px;
  Beam apart = passed;
  apart.wave = face.split_wave;
  apart.locked = true;
  SplitStart start{&at.hits.point, &at.hits.point_error, 0,          each, &at.here.through,
                   at.after,       at.fan.level + 1,     at.fan.mask};
  auto const goes_on = [&](int ray) {
    return any_above(passed.throughput + ray * each, each, stage_.adc_bailout);
  };
  for (int ray = 0, next = 0; ray < rays; ray = next) {
    next = ray + 1;
    if (!goes_on(ray)) {
      cut(passed.ray(ray, each), each);
      continue;
    }
    // Those next to each other together, where each lane goes its own way.
    while (!(tolerance_px > 0) && next < rays && goes_on(next)) ++next;
    counts_.splits += static_cast<std::uint64_t>(next - ray);
    start.first = static_cast<std::size_t>(ray);
    Beam const lanes = apart.from(ray * each, (next - ray) * each);
    SplitWays const own = ways.from(ray * each);
    if (face.picks)
      send_picked(start, lanes, own);
    else if (tolerance_px > 0)
      split_adaptively(start, lanes, own, tolerance_px);
    else
      send_apart(start, lanes, own);
  }
}

void Tracer::meet_comb_fan(FanMet const& at, Beam const& light, LaneInterface& face) {
  int const rays = static_cast<int>(at.fan.lines->count), each = at.fan.lanes_each;
  LaneInterface flat = face;
  flat.splits = false;
  Beam control = light;
  control.control = true;
  control.comb = face.comb;
  auto const n = static_cast<std::size_t>(light.lanes);
  control.throughput = arena_.take<double>(n);
  std::copy_n(light.throughput, n, control.throughput);
  Beam control_back = control;
  control_back.throughput = arena_.take<double>(n);
  // The surface's own light is added here, once.
  double const* const passed = share(at, control, flat, control_back.throughput);

  {
    Arena::Scope const scope(arena_);
    FanRay fan = at.fan;
    fan.lanes_each = waves_.teeth(face.comb);
    FanMet const of_teeth{fan, at.hits, at.met, at.after, at.here};
    Beam const teeth = combed(light, face.comb, rays);
    SplitWays const ways = meet_split(of_teeth, teeth, face);
    Beam back = teeth;
    back.throughput = arena_.take<double>(static_cast<std::size_t>(teeth.lanes));
    for (int ray = 0, k = 0; ray < rays; ++ray) {
      int const first = ray * each;
      auto const let_through = [&](int tooth) {
        int const channel = std::clamp(teeth.channel[tooth] - light.channel[first], 0, each - 1);
        return passed ? passed[first + channel] : 1;
      };
      bool passes = false;
      for (int i = 0; i < fan.lanes_each; ++i) passes = passes || let_through(k + i) > 0;
      for (int i = 0; i < fan.lanes_each; ++i, ++k) {
        double on = let_through(k), asked = 0;
        LaneSurface const surface{&on, &asked};
        back.throughput[k] = teeth.throughput[k] * surface.mirrored_weight(face, 0, passes, k);
        teeth.throughput[k] *= surface.passed_weight(face, 0, k);
      }
    }
    go_on(of_teeth, back, teeth, face, ways);
  }
  if (!film_.has_control(face.comb)) return;
  control.slot = control_back.slot = control_slots(control);
  go_on(at, control_back, control, flat, {});
}

} // namespace abbe::render
