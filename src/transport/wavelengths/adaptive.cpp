// SPDX-License-Identifier: MIT
#include "transport/wavelengths/adaptive.hpp"

#include <algorithm>
#include <limits>

namespace abbe::transport {
namespace {

/// Of lanes together, what each takes is less than what finding those to be spared would.
constexpr int few_lanes = 6;

} // namespace

void SplitAdaptively::split(SplitTools const& tools, SplitRays const& rays) const {
  for (std::size_t r = 0; r < rays.chunk.count; ++r)
    if (rays.goes_on(r, tools.stage.adc_bailout))
      tools.adaptive.add(tools, rays, r);
    else
      tools.emitter.cut(rays.chunk.slot[r], rays.light + r * rays.chunk.each, rays.chunk.each);
}

void AdaptiveSplits::add(SplitTools const& tools, SplitRays const& rays, std::size_t r) {
  Chunk const& chunk = rays.chunk;
  if (splits_.empty()) {
    lights_.clear();
    ways_.clear();
    channels_.clear();
  }
  Split const split{chunk.kind,
                    chunk.mask,
                    rays.wave,
                    chunk.each,
                    lights_.size(),
                    rays.tolerance_px,
                    chunk.slot[r],
                    chunk.sample[r],
                    chunk.after[r],
                    chunk.path[r],
                    chunk.tooth[r],
                    chunk.level[r],
                    chunk.point.get(r),
                    chunk.point_error.get(r),
                    chunk.start_of(r, true)};
  for (std::size_t c = 0, k = r * chunk.each; c < chunk.each; ++c, ++k) {
    lights_.push_back(rays.light[k]);
    ways_.emplace_back(rays.ways.x[k], rays.ways.y[k], rays.ways.z[k]);
    channels_.push_back(chunk.channels[k]);
  }
  splits_.push_back(split);
  auto const number = static_cast<std::uint32_t>(splits_.size() - 1);
  auto const carries = [&](int lane) {
    return lights_[split.first + static_cast<std::size_t>(lane)] > stage_.adc_bailout;
  };
  auto const lambda_nm = [&](int lane) {
    return stage_.lambda_nm(channels_[split.first + static_cast<std::size_t>(lane)]);
  };
  int const lanes = static_cast<int>(split.lanes);
  for (int first = 0; first < lanes;) {
    if (!carries(first)) {
      auto const at = static_cast<std::uint32_t>(first);
      tools.emitter.cut(split.slot + at, &lights_[split.first + at], 1);
      ++first;
      continue;
    }
    // Wavelengths rise within a range: lines come after the bands.
    int last = first;
    while (last + 1 < lanes && carries(last + 1) && lambda_nm(last) < lambda_nm(last + 1)) ++last;
    std::uint32_t const from = send_alone(tools, split, first);
    if (last > first)
      between_.push_back({number, first, last, from, send_alone(tools, split, last)});
    first = last + 1;
  }
}

std::uint32_t AdaptiveSplits::send_alone(SplitTools const& tools, Split const& split, int lane) {
  auto const [path, route] =
      paths_.start_route(split.path, lights_[split.first + static_cast<std::size_t>(lane)]);
  send(tools, split, lane, 1, lane, path);
  return route;
}

void AdaptiveSplits::send(SplitTools const& tools, Split const& split, int first, int count,
                          int way, std::uint32_t path) {
  RayCounts& counts = tools.emitter.counts;
  auto const at = split.first + static_cast<std::size_t>(first);
  std::uint32_t const slot = split.slot + static_cast<std::uint32_t>(first);
  auto const n = static_cast<std::size_t>(count);
  ++counts.monochromatic;
  tools.emitter.count_ray(split.sample);
  if (split.level + 1 >= stage_.max_trace_level) return tools.emitter.cut(slot, &lights_[at], n);
  LightKind const kind{count, split.wave, split.kind.comb, true, split.kind.control};
  Rays& to = tools.emitter.queue({kind, split.mask, false});
  std::size_t const k = to.add(1);
  to.origin.set(k, split.point);
  to.origin_error.set(k, split.point_error);
  to.direction.set(k, ways_[split.first + static_cast<std::size_t>(way)]);
  to.start[k] = split.start;
  to.stack[k] = split.stack;
  to.slot[k] = slot;
  to.channel[k] = channels_[at];
  to.tooth[k] = static_cast<std::uint16_t>(split.tooth + way);
  to.level[k] = static_cast<std::uint16_t>(split.level + 1);
  std::copy_n(lights_.begin() + static_cast<std::ptrdiff_t>(at), n, to.light_of(k));
  if (tools.emitter.fields().travelled) to.travelled[k] = 0;
  to.path[k] = path;
}

void AdaptiveSplits::part(SplitTools const& tools, Between const& between) {
  Split const split = splits_[between.split];
  auto const [number, first, last, from, to] = between;
  int const inner = last - first - 1;
  if (inner < 1) return;
  int const middle = first + (last - first) / 2;
  double const steps =
      paths_.finished(from).apart_px(paths_.finished(to), footprint_, !stage_.sky_pigments.empty())
      / split.tolerance_px;
  if (steps <= 1) return send(tools, split, first + 1, inner, middle, split.path);
  // Each would go alone; or a few, between which an edge lies.
  bool const known = steps < std::numeric_limits<double>::infinity();
  if (known ? steps > inner : inner <= few_lanes) {
    for (int lane = first + 1; lane < last; ++lane) send(tools, split, lane, 1, lane, split.path);
    return;
  }
  std::uint32_t const here = send_alone(tools, split, middle);
  next_.push_back({number, first, middle, from, here});
  next_.push_back({number, middle, last, here, to});
}

bool AdaptiveSplits::go_on(SplitTools const& tools) {
  if (between_.empty()) return false;
  next_.clear();
  for (Between const& between : between_) part(tools, between);
  std::swap(between_, next_);
  return true;
}

} // namespace abbe::transport
