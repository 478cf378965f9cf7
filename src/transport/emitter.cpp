// SPDX-License-Identifier: MIT
#include "transport/emitter.hpp"

#include "simd/math.hpp"
#include "transport/runs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::transport {

Emitter::Emitter(Stage const& stage, Arena& arena, WaveTables& waves, SampleFilm& film,
                 Paths& paths)
    : stage_(stage), arena_(arena), waves_(waves), film_(film) {
  fields_.travelled = stage.has_priorities;
  fields_.path = stage.has_adaptive || paths.records();
  counts_samples_ = stage.most_rays > 0;
}

void Emitter::start_samples(std::size_t count) {
  lost_.assign(count, {});
  loses_ = false;
  lost_apart_.clear();
  if (counts_samples_) rays_of_sample.assign(count, 0);
  if (stage_.most_rays > 0) thresholds_.assign(count, stage_.adc_bailout);
  next_->clear();
}

Queues<QueueKey>& Emitter::turn() {
  std::swap(now_, next_);
  next_->clear();
  if (stage_.most_rays == 0) return *now_;
  // Twice as much for each sixteenth more, up to what POV-Ray ends all paths at. Mirrors that give
  // back more than they get would go on for ever: a sample that has taken 64 times the rays asks
  // for more and more without a bound.
  constexpr double most = 1.0 / 255;
  constexpr double endless = 64;
  double const step = stage_.most_rays / 16.0;
  for (std::size_t sample = 0; sample < rays_of_sample.size(); ++sample) {
    if (rays_of_sample[sample] <= stage_.most_rays) continue;
    double const over = (rays_of_sample[sample] - stage_.most_rays) / step;
    thresholds_[sample] = std::min(most, stage_.adc_bailout * simd::exp(std::numbers::ln2 * over));
    double const beyond = rays_of_sample[sample] / (endless * stage_.most_rays) - 1;
    if (beyond > 0) thresholds_[sample] *= simd::exp(std::min(16 * beyond, 800.0));
  }
  return *now_;
}

Departing Emitter::room(LightKind const& kind, std::size_t count) const {
  Departing out;
  out.kind = kind;
  out.ray = arena_.take<std::uint32_t>(count);
  out.x = arena_.take<double>(count);
  out.y = arena_.take<double>(count);
  out.z = arena_.take<double>(count);
  out.level = arena_.take<std::uint16_t>(count);
  out.slot = arena_.take<std::uint32_t>(count);
  out.channel = arena_.take<std::uint16_t>(count);
  out.tooth = arena_.take<std::uint16_t>(count);
  if (kind.listed()) out.channels = arena_.take<std::uint16_t>(count * kind.size());
  out.light = arena_.take<double>(count * kind.size());
  return out;
}

bool Emitter::lose(std::uint32_t slot, double const* light, std::size_t lanes) {
  SampleFilm::Block const block = film_.block_of(slot);
  if (film_.is_sample(block)) {
    Vec3 const sum = film_.size_of(slot, light, lanes, waves_);
    if (sum == Vec3(0)) return false;
    loses_ = true;
    for (int c = 0; c < 3; ++c) lost_[block][static_cast<std::size_t>(c)].add(sum[c]);
    return true;
  }
  std::size_t const at = slot - film_.first(static_cast<SampleFilm::Block>(lost_.size()));
  if (lost_apart_.size() < at + lanes) lost_apart_.resize(at + lanes);
  for (std::size_t k = 0; k < lanes; ++k) lost_apart_[at + k].add(std::abs(light[k]));
  return any_but_zero(light, lanes);
}

void Emitter::cut(std::uint32_t slot, double const* light, std::size_t lanes) {
  if (lose(slot, light, lanes)) ++cut_light.paths;
}

double Emitter::lost_of(std::size_t sample) const {
  if (!loses_) return 0;
  auto const& [r, g, b] = lost_[sample];
  return std::max({r.value(), g.value(), b.value()});
}

double Emitter::lost_at(std::uint32_t slot) const {
  std::size_t const at = slot - film_.first(static_cast<SampleFilm::Block>(lost_.size()));
  return at < lost_apart_.size() ? lost_apart_[at].value() : 0;
}

template <class RayOf>
void Emitter::set_starts(Chunk const& chunk, Rays& to, std::size_t first, std::size_t count,
                         bool through, RayOf const& ray_of) const {
  auto const copy = [&](geometry::VectorArrays const& out, Vectors const& in) {
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t const r = ray_of(i);
      out.x[first + i] = in.x[r];
      out.y[first + i] = in.y[r];
      out.z[first + i] = in.z[r];
    }
  };
  copy(to.origin, chunk.point);
  copy(to.origin_error, chunk.point_error);
  MediaStacks::Id const* const stack = through ? chunk.after : chunk.before;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t const r = ray_of(i);
    to.start[first + i] = chunk.start_of(r, through);
    to.stack[first + i] = stack[r];
  }
}

void Emitter::send(Chunk const& chunk, Onward const& rays) {
  ChunkLight const& like = rays.like;
  std::size_t const n = like.each;
  std::uint16_t going[chunk_width];
  std::size_t count = 0;
  std::uint64_t counted = 0;
  each_of(rays.rays, [&](std::size_t r) {
    double const* const light = rays.light + r * n;
    double const least = threshold(chunk.sample[r]);
    bool goes = n == 1 ? std::fabs(*light) > least : any_above(light, n, least);
    if (goes) {
      ++counted;
      count_ray(chunk.sample[r]);
      goes = chunk.level[r] + static_cast<int>(rays.deeper >> r & 1) < stage_.max_trace_level;
    }
    if (goes)
      going[count++] = static_cast<std::uint16_t>(r);
    else
      cut(rays.slot[r], light, n);
  });
  counts.*rays.counted += counted;
  if (count == 0) return;
  Rays& to = queue({like.kind, rays.mirrored != 0 ? reflection_bit : chunk.mask, rays.mirrored});
  std::size_t const first = to.add(count);
  Runs const runs(going, count);
  runs.take_vectors(chunk.point, to.origin, first);
  runs.take_vectors(chunk.point_error, to.origin_error, first);
  runs.take_vectors(rays.way, to.direction, first);
  runs.take(rays.mirrored != 0 ? chunk.before : chunk.after, to.stack.data() + first);
  runs.take(rays.slot, to.slot.data() + first);
  runs.take(like.tooth, to.tooth.data() + first);
  runs.take(rays.light, to.light_of(first), n);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t const r = going[i], k = first + i;
    to.start[k] = chunk.start_of(r, rays.mirrored == 0);
    to.channel[k] = like.channels[r * n];
    to.level[k] = static_cast<std::uint16_t>(chunk.level[r] + (rays.deeper >> r & 1));
  }
  if (like.kind.listed())
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(like.channels + going[i] * n, n, to.channels.data() + (first + i) * n);
  if (fields_.travelled)
    std::fill_n(to.travelled.begin() + static_cast<std::ptrdiff_t>(first), count, 0.0);
  if (fields_.path)
    for (std::size_t i = 0; i < count; ++i) to.path[first + i] = chunk.path[going[i]];
}

void Emitter::send(Chunk const& chunk, Departing const& rays) {
  Arena::Scope const scope(arena_);
  std::size_t const n = rays.kind.size();
  auto* const going = arena_.take<std::uint32_t>(rays.count);
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.count; ++i) {
    double const* const light = rays.light + i * n;
    bool goes =
        rays.counted == nullptr || any_above(light, n, threshold(chunk.sample[rays.ray[i]]));
    if (goes && rays.counted != nullptr) {
      ++(counts.*rays.counted);
      count_ray(chunk.sample[rays.ray[i]]);
    }
    goes = goes && rays.level[i] < stage_.max_trace_level;
    if (goes)
      going[count++] = static_cast<std::uint32_t>(i);
    else
      cut(rays.slot[i], light, n);
  }
  if (count == 0) return;
  Rays& to = queue({rays.kind, rays.mirrored != 0 ? reflection_bit : chunk.mask, rays.mirrored});
  std::size_t const first = to.add(count);
  auto const each = [&](auto const& work) {
    for (std::size_t i = 0; i < count; ++i) work(first + i, going[i]);
  };
  set_starts(chunk, to, first, count, rays.mirrored == 0,
             [&](std::size_t i) { return rays.ray[going[i]]; });
  each([&](std::size_t k, std::uint32_t i) {
    to.direction.x[k] = rays.x[i];
    to.direction.y[k] = rays.y[i];
    to.direction.z[k] = rays.z[i];
  });
  each([&](std::size_t k, std::uint32_t i) {
    to.slot[k] = rays.slot[i];
    to.channel[k] = rays.channel[i];
    to.tooth[k] = rays.tooth[i];
    to.level[k] = rays.level[i];
  });
  if (n == 1)
    each([&](std::size_t k, std::uint32_t i) { to.light[k] = rays.light[i]; });
  else
    each([&](std::size_t k, std::uint32_t i) {
      std::copy_n(rays.light + i * n, n, to.light_of(k));
    });
  if (rays.kind.listed())
    each([&](std::size_t k, std::uint32_t i) {
      std::copy_n(rays.channels + i * n, n, to.channels.data() + k * n);
    });
  if (fields_.travelled)
    each([&](std::size_t k, std::uint32_t i) {
      to.travelled[k] = rays.counted == nullptr ? chunk.travelled[rays.ray[i]] : 0;
    });
  if (fields_.path)
    each([&](std::size_t k, std::uint32_t i) {
      to.path[k] = rays.path != nullptr ? rays.path[i] : chunk.path[rays.ray[i]];
    });
}

} // namespace abbe::transport
