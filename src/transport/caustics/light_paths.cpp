// SPDX-License-Identifier: MIT
#include "transport/caustics/light_paths.hpp"

#include "transport/meeting.hpp"
#include "transport/segments/absorption.hpp"

#include <algorithm>

namespace abbe::transport::caustics {
namespace {

bool at_most_absorbs(Medium const& medium) {
  return std::ranges::all_of(medium.segments, [](auto const& segment) {
    return dynamic_cast<Absorption const*>(segment.get()) != nullptr;
  });
}

} // namespace

void bend(Stage const& stage, Arena& arena, Chunk& c) {
  auto const fill = [&](auto& values, auto const& get) {
    for (std::size_t r = c.count; r % 8 != 0; ++r) values.set(r, get(values));
  };
  auto const last = [&](Vectors const& v) { return v.get(c.count - 1); };
  fill(c.direction, last);
  fill(c.point, last);
  for (std::size_t r = c.count; r % 8 != 0; ++r) {
    c.n1[r] = c.n1[c.count - 1];
    c.n2[r] = c.n2[c.count - 1];
  }
  stage.world->normals(c.count, c.hit, c.point.arrays(), c.normal.arrays(), c.geometric.arrays());
  fill(c.normal, last);
  fill(c.geometric, last);
  bool smoothed = false;
  for (std::size_t r = 0; r < c.count; ++r)
    smoothed = smoothed || c.normal.get(r) != c.geometric.get(r);
  face_rays(c, smoothed);
  c.tilts = false;
  if (!stage.textures.normals.empty() && tilts(stage, c.hit[0].primitive))
    tilt_top(stage, arena, c);
  refract_rays(c);
}

void LightPaths::Front::clear() {
  count = 0;
  start.clear();
  stack.clear();
  ray.clear();
  segment.clear();
  chain.clear();
  bent.clear();
  level.clear();
  length.clear();
  light.clear();
}

std::size_t LightPaths::Front::add() {
  if (count == vectors[0].size()) {
    for (auto& values : vectors) values.resize(std::max<std::size_t>(64, 2 * count));
    origin = {vectors[0].data(), vectors[1].data(), vectors[2].data()};
    direction = {vectors[3].data(), vectors[4].data(), vectors[5].data()};
    error = {vectors[6].data(), vectors[7].data(), vectors[8].data()};
  }
  return count++;
}

LightPaths::LightPaths(Stage const& stage, Waves const& waves, Limits const& limits)
    : stage_(stage),
      waves_(waves),
      limits_(limits),
      scratch_(geometry::World::make_scratch()),
      stacks_(stage),
      insides_(stage, stacks_, *scratch_),
      aims_(stage.lamps.size()) {}

void LightPaths::branches(Starts const& starts, ChainTable& chains, std::vector<Segment>& out) {
  grows_ = &chains;
  chains_ = &chains;
  arrived_ = nullptr;
  run(starts, out);
}

void LightPaths::along_targets(Starts const& starts, ChainTable const& chains,
                               std::vector<Segment>& out, std::vector<double>& light) {
  grows_ = nullptr;
  chains_ = &chains;
  arrived_ = &light;
  light.assign(starts.count() * starts.each, 0.0);
  run(starts, out);
}

void LightPaths::run(Starts const& starts, std::vector<Segment>& out) {
  out.clear();
  start(starts);
  while (fronts_[turn_].count > 0) {
    Front& now = fronts_[turn_];
    fronts_[1 - turn_].clear();
    groups_[1 - turn_].clear();
    rays_ += now.count;
    stage_.world->intersect(now.lines(groups_[turn_]), light_bits, nullptr, *scratch_, hits_);
    arrive(now, out);
    buckets_.sort({keys_.data(), now.count}, hits_.groups);
    buckets_.each([&](BucketKey const& key, std::span<std::uint32_t const> places) {
      if (key.kind == BucketKey::Kind::Nothing) return;
      for (; !places.empty(); places = places.subspan(chunk_.count)) {
        Arena::Scope const scope(arena_);
        meet(starts, now, key, places.first(std::min(places.size(), chunk_width)), out);
      }
    });
    turn_ = 1 - turn_;
  }
}

void LightPaths::start(Starts const& starts) {
  Front& front = fronts_[turn_];
  front.clear();
  groups_[turn_].clear();
  MediaStacks::Id stack = MediaStacks::none;
  for (std::size_t k = 0; k < starts.count(); ++k) {
    std::size_t const at = front.add();
    front.origin.set(at, starts.origin[k]);
    front.direction.set(at, starts.direction[k]);
    front.error.set(at, Vec3(0));
    front.start.emplace_back();
    if (k == 0 || starts.origin[k] != starts.origin[k - 1]) stack = insides_.at(starts.origin[k]);
    front.stack.push_back(stack);
    front.ray.push_back(static_cast<std::uint32_t>(k));
    front.segment.push_back(no_segment);
    front.chain.push_back(0);
    front.bent.push_back(0);
    front.level.push_back(0);
    front.length.push_back(0);
    front.light.insert(front.light.end(), starts.each, 1.0);
  }
}

bool LightPaths::receives(geometry::RayHit const& hit) const {
  if (hit.kind == geometry::RayHit::Kind::Nothing) return false;
  return stage_.receives[hit.primitive];
}

void LightPaths::arrive(Front& now, std::vector<Segment>& out) {
  keys_.resize(std::max(keys_.size(), now.count));
  before_.resize(keys_.size());
  after_.resize(keys_.size());
  for (std::size_t k = 0; k < now.count; ++k) {
    geometry::RayHit const& hit = hits_.hit[k];
    bool const found = hit.kind != geometry::RayHit::Kind::Nothing;
    if (now.segment[k] != no_segment) {
      Segment& segment = out[now.segment[k]];
      segment.far = found ? hits_.t[k] : std::numeric_limits<double>::infinity();
      segment.receives = receives(hit);
    }
    before_[k] = after_[k] = now.stack[k];
    keys_[k] = {};
    if (found) keys_[k] = meeting_of(stage_, stacks_, hits_, k, before_[k], after_[k]);
  }
}

void LightPaths::gather(Starts const& starts, Front const& now, BucketKey const& key,
                        std::span<std::uint32_t const> places) {
  Chunk& c = chunk_;
  std::size_t const n = starts.each;
  c.kind = LightKind{static_cast<int>(n), starts.in_order ? polychromatic : band_means};
  c.mask = camera_bit;
  c.count = places.size();
  c.each = n;
  c.channels = arena_.take<std::uint16_t>(c.lanes() + 8);
  c.light = arena_.take<double>(c.lanes() + 8);
  c.medium_before = key.before;
  c.medium_after = key.after;
  for (std::size_t r = 0; r < c.count; ++r) {
    std::size_t const k = places[r];
    c.direction.set(r, now.direction.get(k));
    c.point.set(r, hits_.point.get(k));
    c.point_error.set(r, hits_.point_error.get(k));
    c.hit[r] = hits_.hit[k];
    c.before[r] = before_[k];
    c.after[r] = after_[k];
    c.sample[r] = 0;
    c.slot[r] = 0;
    c.tooth[r] = 0;
    int const wave = starts.wave[now.ray[k]];
    c.n1[r] = waves_.index(wave, key.before);
    c.n2[r] = waves_.index(wave, key.after);
    chunk_way_[r] = hits_.t[k];
    std::copy_n(starts.channels.data() + now.ray[k] * n, n, c.channels + r * n);
    std::copy_n(now.light.data() + k * n, n, c.light + r * n);
  }
}

void LightPaths::meet(Starts const& starts, Front const& now, BucketKey const& key,
                      std::span<std::uint32_t const> places, std::vector<Segment>& out) {
  using Kind = BucketKey::Kind;
  Chunk& c = chunk_;
  c.group = nullptr;
  if (key.kind == Kind::Several) {
    c.group = &hits_.groups[key.number];
    c.crossings = c.group->crossings;
    c.start_group = groups_[1 - turn_].count();
    groups_[1 - turn_].add().members = c.group->members;
  }
  gather(starts, now, key, places);
  bool const displaced = key.kind == Kind::Displaced || (c.group != nullptr && c.crossings.empty());
  Passage const way{c.count, c.each, c.channels, chunk_way_.value, c.light, true};
  Way::along(stage_.medium(key.before), way);
  if (!displaced && key.left != 0) Way::leave(stage_.medium(key.left), way);
  if (displaced) {
    for (std::size_t r = 0; r < c.count; ++r) {
      Front& next = fronts_[1 - turn_];
      std::size_t const k = places[r], at = next.add();
      next.origin.set(at, c.point.get(r));
      next.direction.set(at, c.direction.get(r));
      next.error.set(at, c.point_error.get(r));
      next.start.push_back(c.start_of(r, true));
      next.stack.push_back(c.after[r]);
      next.ray.push_back(now.ray[k]);
      next.segment.push_back(now.segment[k]);
      next.chain.push_back(now.chain[k]);
      next.bent.push_back(now.bent[k]);
      next.level.push_back(now.level[k]);
      next.length.push_back(now.length[k] + hits_.t[k]);
      next.light.insert(next.light.end(), c.light + r * c.each, c.light + (r + 1) * c.each);
    }
    return;
  }
  bend(stage_, arena_, c);
  Shares shares;
  bool const fresnel = stage_.medium(key.before).fresnel || stage_.medium(key.after).fresnel;
  if (is_bare(stage_, c)) {
    find_shares(arena_, c, fresnel, false, nullptr, shares);
  } else {
    SurfaceLight const surface =
        shade(stage_, arena_, aims_, c, {nullptr, c.reflectance.value}, false, nullptr);
    find_shares(arena_, c, fresnel, false, &surface, shares);
  }
  each_of(shares.passing & ~c.total,
          [&](std::size_t r) { send(starts, now, places, r, false, shares.on + r * c.each, out); });
  each_of(shares.returning, [&](std::size_t r) {
    send(starts, now, places, r, true, shares.back + r * c.each, out);
  });
}

void LightPaths::send(Starts const& starts, Front const& now, std::span<std::uint32_t const> places,
                      std::size_t r, bool mirror, double const* light, std::vector<Segment>& out) {
  Chunk const& c = chunk_;
  std::size_t const k = places[r], n = c.each;
  double const power = *std::max_element(light, light + n);
  if (!(power > 0)) return;
  Casts const& casts = stage_.casts[c.hit[r].solid];
  scene::LampThrows const& lamp = stage_.lamps[starts.lamp]->throws();
  bool const before_target = now.bent[k] == 0;
  bool const straight = !mirror && (c.n1[r] == c.n2[r] || (casts.pass_through && before_target));
  bool const total = (c.total >> r & 1) != 0;
  bool const refracts = Casts::goes_on(casts.refraction, lamp.refraction),
             reflects = Casts::goes_on(casts.reflection, lamp.reflection);
  if (!straight && !(mirror ? reflects || (total && refracts) : refracts)) return;
  if (!straight && before_target && !casts.target) return; // in the way of those that are
  Step step;
  step.primitive = c.hit[r].primitive;
  step.solid = c.hit[r].solid;
  step.flat = stage_.world->shape(step.primitive).flat(c.hit[r].face);
  step.face = step.flat ? c.hit[r].face : 0;
  step.entering = c.hit[r].was_entering;
  step.mirror = mirror;
  step.bends = !straight;
  step.before = c.medium_before;
  step.after = c.medium_after;
  if (step.flat) {
    step.point = c.point.get(r);
    step.normal = c.geometric.get(r);
  }
  auto const level = static_cast<std::size_t>(now.level[k]);
  int chain = now.chain[k];
  bool last = false;
  if (!starts.target.empty()) {
    auto const& steps = (*chains_)[starts.target[now.ray[k]]].steps;
    if (level >= steps.size() || !steps[level].same(step)) return;
    last = level + 1 == steps.size();
  } else {
    if (power < limits_.adc_bailout || static_cast<int>(level) + 1 >= limits_.max_trace_level) {
      cut_ += power;
      return;
    }
    auto const& before = stage_.medium(step.before);
    auto const& after = stage_.medium(step.after);
    ChainTable::Colours colours;
    colours.disperses = step.bends && (before.dispersive || after.dispersive);
    colours.coloured = !before.segments.empty() || !after.segments.empty() || !is_bare(stage_, c);
    colours.plain = c.group == nullptr && !c.tilts && is_bare(stage_, c) && at_most_absorbs(before);
    colours.absorbing = before.segments.empty() ? -1 : step.before;
    chain = grows_->extended(chain, step, colours);
  }
  Vec3 const direction = mirror     ? c.mirrored.get(r)
                         : straight ? c.direction.get(r)
                                    : c.refracted.get(r);
  double const length = now.length[k] + chunk_way_[r];
  std::uint32_t segment = no_segment;
  if (last || (starts.target.empty() && (*chains_)[chain].bends)) {
    segment = static_cast<std::uint32_t>(out.size());
    out.push_back({now.ray[k], starts.target.empty() ? chain : starts.target[now.ray[k]],
                   c.point.get(r), direction, length, power, 0, false});
  }
  if (last) {
    std::copy_n(light, n, arrived_->data() + now.ray[k] * n);
    return;
  }
  Front& next = fronts_[1 - turn_];
  std::size_t const at = next.add();
  next.origin.set(at, c.point.get(r));
  next.direction.set(at, direction);
  next.error.set(at, c.point_error.get(r));
  next.start.push_back(c.start_of(r, !mirror));
  next.stack.push_back(mirror ? c.before[r] : c.after[r]);
  next.ray.push_back(now.ray[k]);
  next.segment.push_back(segment);
  next.chain.push_back(chain);
  next.bent.push_back(now.bent[k] != 0 || step.bends ? 1 : 0);
  next.level.push_back(now.level[k] + 1);
  next.length.push_back(length);
  next.light.insert(next.light.end(), light, light + n);
}

} // namespace abbe::transport::caustics
