// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"
#include "render/tracer.hpp"

#include <algorithm>

/// Samples that enter dispersive glass next to each other: their rays of single wavelengths fill
/// fans together, sample by sample. What happens to each has the bits of Tracer::split().
namespace abbe::render {

SplitWays Tracer::meet_split(FanRay const& fan, FanInterface const& met, LaneInterface& face) {
  auto const each = static_cast<std::size_t>(fan.lanes_each);
  std::size_t const n = fan.lines->count, lanes = n * each + 3; // written four at a time
  auto const values = [&](std::size_t count) { return arena_.take<double>(count); };
  auto const padded = [&](std::span<double const> indices) {
    double* const out = values((each + 3) / 4 * 4);
    std::copy_n(indices.begin(), each, out);
    for (std::size_t c = each; c % 4 != 0; ++c) out[c] = out[each - 1];
    return out;
  };
  double const* const n1 = padded(waves_.indices(face.before, band_means));
  double const* const n2 = padded(waves_.indices(face.after, band_means));
  face.reflectance = values(lanes);
  face.transmittance = values(lanes);
  face.total = arena_.take<bool>(lanes);
  SplitWays const ways{values(lanes), values(lanes), values(lanes)};
  for (std::size_t k = 0; k < n; ++k)
    meet_lanes(fan.lines->direction.get(k), met.normal.get(k), met.cos_i[k],
               {n1, n2, each, face.reflectance + k * each, face.transmittance + k * each,
                face.total + k * each, ways.x + k * each, ways.y + k * each, ways.z + k * each});
  return ways;
}

void Tracer::split_fan(FanRay const& fan, geometry::FanHits const& hits, Beam const& passed,
                       SplitWays const& ways, double tolerance_px, InsideNode const* after,
                       Frame& here) {
  int const each = fan.lanes_each, rays = passed.lanes / each;
  Beam apart = passed;
  apart.wave = band_means;
  apart.locked = true;
  SplitStart start{&hits.point, &hits.point_error, 0,       each, &here.through,
                   after,       fan.level + 1,     fan.mask};
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
    if (tolerance_px > 0)
      split_adaptively(start, lanes, ways.from(ray * each), tolerance_px);
    else
      send_apart(start, lanes, ways.from(ray * each));
  }
}

} // namespace abbe::render
