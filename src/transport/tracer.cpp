// SPDX-License-Identifier: MIT
#include "transport/tracer.hpp"

#include "transport/meeting.hpp"
#include "transport/tilt.hpp"

#include "transport/runs.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace abbe::transport {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of a generation, before some samples wait: what fits the caches.
constexpr std::size_t most_rays = std::size_t{1} << 14;

int rays_of_point(Stage const& stage) {
  return stage.camera->rays_of_point();
}

/// Large enough for full buckets, and small enough for the caches.
std::size_t batch_of(Stage const& stage) {
  if (int const each = rays_of_point(stage); each > 1)
    return std::max<std::size_t>(1, 1024 / static_cast<std::size_t>(each));
  std::size_t lanes = static_cast<std::size_t>(stage.channels);
  for (auto const& comb : stage.combs)
    lanes += static_cast<std::size_t>(std::max(comb.teeth, stage.channels));
  return std::clamp<std::size_t>(8192 / lanes, 128, 1024);
}

} // namespace

Tracer::Tracer(Stage const& stage, Footprint footprint, PathRecord* record)
    : stage_(stage),
      scratch_(geometry::World::make_scratch()),
      batch_(batch_of(stage)),
      waves_(stage, batch_),
      film_(stage, waves_, batch_),
      stacks_(stage),
      paths_(stage, record),
      emitter_(stage, arena_, waves_, film_, paths_),
      shadows_(stage, arena_, *scratch_, film_, stacks_, paths_),
      captures_(stage, waves_, film_, emitter_, paths_),
      adaptive_(stage, footprint, paths_),
      comb_light_(waves_, film_, arena_),
      way_(stage, stacks_),
      insides_(stage, stacks_, *scratch_),
      aims_(stage.lamps.size()) {
  if (stage.caustics)
    caustic_lights_ = std::make_unique<caustics::CausticLights>(stage, *stage.caustics);
  if (stage.camera->has_one_point() && !stage.lens) camera_stack_ = insides_.at(Vec3(0));
}

namespace {

/// Rays of points that show nothing go somewhere, without light; those of one point share its
/// light. @param each rays of a point
void darken_unseen(Rays& rays, std::size_t each) {
  for (std::size_t first = 0; first < rays.count(); first += each) {
    std::size_t seen = 0;
    for (std::size_t k = first; k < first + each; ++k) seen += rays.direction.get(k) != Vec3(0);
    for (std::size_t k = first; k < first + each; ++k) {
      bool const sees = rays.direction.get(k) != Vec3(0);
      if (!sees) rays.direction.set(k, Vec3(0, 0, 1));
      std::fill_n(rays.light_of(k), rays.kind().size(),
                  sees ? 1.0 / static_cast<double>(seen) : 0.0);
    }
  }
}

} // namespace

void Tracer::start_camera(PicturePoints const& points, std::span<SampleKey const> keys) {
  LightKind const kind{stage_.channels};
  Rays& rays = emitter_.queue({kind, camera_bit, false});
  auto const each = static_cast<std::size_t>(rays_of_point(stage_));
  std::size_t const count = points.count * each;
  rays.add(count);
  first_rays_ = true;
  stage_.camera->rays(points, rays.origin, rays.direction);
  if (stage_.lens) stage_.lens->spread(rays, keys);
  if (stage_.camera_normal >= 0) tilt_camera_rays(stage_, points, each, rays);
  for (double* const error : {rays.origin_error.x, rays.origin_error.y, rays.origin_error.z})
    std::fill_n(error, count, 0.0);
  std::fill_n(rays.start.begin(), count, geometry::RayStart());
  for (auto* const numbers : {&rays.channel, &rays.tooth, &rays.level})
    std::fill_n(numbers->begin(), count, std::uint16_t{0});
  std::fill_n(rays.light.begin(), count * kind.size(), 1.0 / static_cast<double>(each));
  if (!stage_.camera->sees_all()) darken_unseen(rays, each);
  if (camera_stack_)
    std::fill_n(rays.stack.begin(), count, *camera_stack_);
  else
    for (std::size_t k = 0; k < count; ++k) rays.stack[k] = insides_.at(rays.origin.get(k));
  for (std::size_t k = 0; k < count; ++k) {
    rays.slot[k] = film_.channel_slot(static_cast<SampleFilm::Block>(k / each), 0);
    emitter_.count_ray(k / each);
  }
  if (emitter_.fields().travelled) std::fill_n(rays.travelled.begin(), count, 0.0);
  if (emitter_.fields().path) std::fill_n(rays.path.begin(), count, Paths::none);
  emitter_.counts.camera += count;
  if (stage_.max_trace_level > 0) return;
  for (std::size_t k = 0; k < count; ++k) emitter_.cut(rays.slot[k], rays.light_of(k), kind.size());
  rays.clear();
}

void Tracer::trace(PicturePoints const& points, std::span<SampleKey const> keys) {
  Arena::Scope const scope(arena_);
  film_.start_samples(keys.size());
  waves_.start_samples(keys);
  paths_.start();
  constexpr std::uint64_t of_areas = 0xa3ea;
  jitter_.clear();
  for (SampleKey const& key : keys) jitter_.push_back(key.pixel.child(key.number).child(of_areas));
  emitter_.start_samples(keys.size());
  captures_.start();
  adaptive_.start();
  starts_.clear();
  start_camera(points, keys);
  SplitTools const tools{stage_, arena_, waves_, film_, emitter_, adaptive_};
  do drain();
  while (adaptive_.go_on(tools));
  captures_.resolve();
  for (std::size_t k = 0; k < keys.size(); ++k) {
    double const lost = lost_of(k);
    emitter_.cut_light.worst_sample = std::max(emitter_.cut_light.worst_sample, lost);
    emitter_.cut_light.sum += CutLight::units_of(lost);
  }
}

void Tracer::drain() {
  for (;;) {
    if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) {
      emitter_.next().clear();
      waiting_.clear();
      return;
    }
    if (emitter_.next().count() == 0) {
      if (waiting_.empty()) return;
      take_back();
    }
    if (emitter_.next().count() > most_rays) set_aside();
    emitter_.turn().each([&](QueueKey const& key, Rays& rays) { step(key, rays); });
  }
}

void Tracer::set_aside() {
  std::size_t first = batch_, last = 0;
  auto const each_queue = [&](auto const& work) { emitter_.next().each(work); };
  each_queue([&](QueueKey const&, Rays& rays) {
    for (std::size_t k = 0; k < rays.count(); ++k) {
      std::size_t const sample = film_.sample_of(rays.slot[k]);
      first = std::min(first, sample);
      last = std::max(last, sample);
    }
  });
  if (first == last) return;
  std::size_t const middle = first + (last - first) / 2;
  waiting_.emplace_back();
  each_queue([&](QueueKey const& key, Rays& rays) {
    Rays later(rays.kind(), rays.fields());
    std::size_t kept = 0;
    for (std::size_t k = 0; k < rays.count(); ++k)
      if (film_.sample_of(rays.slot[k]) > middle)
        later.copy(rays, k);
      else
        rays.move(k, kept++);
    rays.keep_first(kept);
    if (later.count() > 0) waiting_.back().emplace_back(key, std::move(later));
  });
}

void Tracer::take_back() {
  for (auto& [key, rays] : waiting_.back()) emitter_.queue(key) = std::move(rays);
  waiting_.pop_back();
}

void Tracer::step(QueueKey const& key, Rays& rays) {
  stage_.world->intersect(rays.lines(starts_), key.mask, nullptr, *scratch_, hits_);
  if (std::exchange(first_rays_, false) && stage_.camera->longest() < infinity)
    for (std::size_t k = 0; k < rays.count(); ++k)
      if (hits_.t[k] > stage_.camera->longest()) hits_.hit[k] = {};
  arrive(rays);
  buckets_.sort({keys_.data(), rays.count()}, hits_.groups);
  buckets_.each([&](BucketKey const& bucket, std::span<std::uint32_t const> places) {
    if (bucket.kind == BucketKey::Kind::Several) {
      chunk_.group = &hits_.groups[bucket.number];
      chunk_.crossings = chunk_.group->crossings;
      chunk_.start_group = starts_.count();
      starts_.add().members = chunk_.group->members;
    } else {
      chunk_.group = nullptr;
    }
    for (; !places.empty(); places = places.subspan(chunk_.count)) {
      Arena::Scope const scope(arena_);
      gather(key, rays, places.first(std::min(places.size(), chunk_width)));
      meet(bucket);
    }
  });
  emitter_.counts.shadow += shadows_.finish(starts_);
}

void Tracer::arrive(Rays& rays) {
  keys_.resize(std::max(keys_.size(), rays.count()));
  before_.resize(keys_.size());
  after_.resize(keys_.size());
  rest_.resize(keys_.size());
  path_.resize(keys_.size());
  // Where media neither displace each other nor leak, most is said at once.
  bool const plain = !stage_.has_priorities && !stage_.has_leaks;
  auto const same = [](geometry::RayHit const& a, geometry::RayHit const& b) {
    return a.kind == b.kind && a.solid == b.solid && a.primitive == b.primitive
           && a.entering == b.entering && a.toggles == b.toggles;
  };
  for (std::size_t k = 0; k < rays.count(); ++k) {
    geometry::RayHit const& met = hits_.hit[k];
    if (!plain || met.kind != geometry::RayHit::Kind::Single) {
      keys_[k] = meeting_of(rays, k);
    } else if (k > 0 && rays.stack[k] == rays.stack[k - 1] && same(met, hits_.hit[k - 1])) {
      keys_[k] = keys_[k - 1];
      before_[k] = before_[k - 1];
      after_[k] = after_[k - 1];
      rest_[k] = hits_.t[k];
    } else {
      keys_[k] = plain_meeting(rays.stack[k], met, k);
    }
  }
  if (!emitter_.fields().path) return;
  for (std::size_t k = 0; k < rays.count(); ++k) {
    geometry::RayHit const& hit = hits_.hit[k];
    bool const met = hit.kind != geometry::RayHit::Kind::Nothing;
    auto const member = hit.kind == geometry::RayHit::Kind::Group
                            ? hits_.groups[hits_.group[k]].members.front().primitive
                            : hit.primitive;
    LightKind const& kind = rays.kind();
    double const lambda_nm =
        kind.monochromatic() && paths_.records()
            ? waves_.lambda_nm(kind.wave, film_.sample_of(rays.slot[k]), rays.tooth[k])
            : 0;
    path_[k] = paths_.arrive(
        rays.path[k], rays.start[k].through, kind, rays.light_of(k), lambda_nm,
        {met, rays.direction.get(k), met ? hits_.point.get(k) : Vec3(0), hit.primitive, member});
  }
}

BucketKey Tracer::plain_meeting(MediaStacks::Id before, geometry::RayHit const& hit,
                                std::size_t k) {
  MediaStacks::Id const after = stacks_.after(before, hit);
  before_[k] = before;
  after_[k] = after;
  rest_[k] = hits_.t[k];
  BucketKey key;
  key.kind = BucketKey::Kind::Surface;
  key.entering = hit.entering;
  key.left = stacks_.left(before, after);
  key.surface = surface_class(stage_.textures, hit.primitive);
  key.before = stacks_.medium(before);
  key.after = stacks_.medium(after);
  return key;
}

BucketKey Tracer::meeting_of(Rays& rays, std::size_t k) {
  using Kind = geometry::RayHit::Kind;
  bool const found = hits_.hit[k].kind != Kind::Nothing;
  double const t = found ? hits_.t[k] : infinity;
  MediaStacks::Id before = rays.stack[k];
  rest_[k] = t;
  if (way_.has_stops(before, !found)) {
    channels_.resize(rays.kind().size());
    channels_of(rays, k, channels_.data());
    auto const end = way_.to_last_stop(
        {rays.origin.get(k), rays.direction.get(k)}, before, t,
        emitter_.fields().travelled ? rays.travelled[k] : 0,
        {1, rays.kind().size(), channels_.data(), nullptr, rays.light_of(k), false});
    before = end.stack;
    rest_[k] = end.rest;
  }
  before_[k] = before;
  if (found) return transport::meeting_of(stage_, stacks_, hits_, k, before, after_[k]);
  after_[k] = before;
  BucketKey key;
  key.before = stacks_.medium(before);
  return key;
}

void Tracer::gather(QueueKey const& key, Rays const& rays, std::span<std::uint32_t const> places) {
  Chunk& c = chunk_;
  LightKind const& kind = rays.kind();
  std::size_t const n = kind.size();
  c.kind = kind;
  c.mask = key.mask;
  c.count = places.size();
  c.each = n;
  c.doubles = kind.listed() && stage_.comb(kind.comb).follow == optics::Comb::Follow::Doubled;
  c.channels = arena_.take<std::uint16_t>(c.lanes() + 8);
  c.light = arena_.take<double>(c.lanes() + 8);
  std::size_t const count = places.size();
  Runs const runs(places.data(), count);
  auto const vectors = [&](Vectors& to, geometry::VectorArrays const& from) {
    runs.take(from.x, to.x);
    runs.take(from.y, to.y);
    runs.take(from.z, to.z);
  };
  vectors(c.direction, rays.direction);
  vectors(c.point, hits_.point);
  vectors(c.point_error, hits_.point_error);
  runs.take(rays.slot.data(), c.slot);
  runs.take(rays.tooth.data(), c.tooth);
  runs.take(rays.level.data(), c.level);
  runs.take(before_.data(), c.before);
  runs.take(after_.data(), c.after);
  runs.take(hits_.hit.data(), c.hit);
  runs.take(rest_.data(), chunk_rest_.value);
  runs.take(hits_.t.data(), chunk_way_.value);
  runs.take(rays.light.data(), c.light, n);
  c.jitter = jitter_.data();
  if (!stage_.air.empty()) {
    vectors(air_.origin, rays.origin);
    air_.rays = 0;
    for (std::size_t r = 0; r < count; ++r) {
      bool const met = c.hit[r].kind != geometry::RayHit::Kind::Nothing;
      air_.distance[r] = met ? chunk_way_[r] : infinity;
      air_.rays |= RaySet{stacks_.in_air(rays.stack[places[r]])} << r;
    }
  }
  for (std::size_t r = 0; r < count; ++r)
    c.sample[r] = static_cast<std::uint32_t>(film_.sample_of(c.slot[r]));
  if (kind.listed()) {
    runs.take(rays.channels.data(), c.channels, n);
  } else if (n == 1) {
    runs.take(rays.channel.data(), c.channels);
  } else {
    for (std::size_t r = 0, lane = 0; r < count; ++r)
      for (std::size_t i = 0; i < n; ++i, ++lane)
        c.channels[lane] = static_cast<std::uint16_t>(rays.channel[places[r]] + i);
  }
  for (std::size_t r = c.count; r % 8 != 0; ++r) { // kernels compute whole lanes
    c.direction.set(r, c.direction.get(c.count - 1));
    c.point.set(r, c.point.get(c.count - 1));
  }
  if (emitter_.fields().travelled)
    for (std::size_t r = 0; r < c.count; ++r) {
      chunk_way_[r] += rays.travelled[places[r]];
      c.travelled[r] = chunk_way_[r];
    }
  if (emitter_.fields().path)
    for (std::size_t r = 0; r < c.count; ++r) c.path[r] = path_[places[r]];
}

void Tracer::find_normals() {
  Chunk& c = chunk_;
  geometry::World const& world = *stage_.world;
  world.normals(c.count, c.hit, c.point.arrays(), c.normal.arrays(), c.geometric.arrays());
  bool smoothed = false;
  for (std::size_t r = 0; r < c.count; ++r)
    smoothed = smoothed || c.normal.x[r] != c.geometric.x[r] || c.normal.y[r] != c.geometric.y[r]
               || c.normal.z[r] != c.geometric.z[r];
  for (std::size_t r = c.count; r % 8 != 0; ++r) {
    c.normal.set(r, c.normal.get(c.count - 1));
    c.geometric.set(r, c.geometric.get(c.count - 1));
  }
  face_rays(c, smoothed);
  c.tilts = false;
  if (!stage_.textures.normals.empty() && tilts(stage_, c.hit[0].primitive))
    tilt_top(stage_, arena_, c);
}

} // namespace abbe::transport
