// SPDX-License-Identifier: MIT
#include "transport/shadows.hpp"

#include "transport/caustics/caustics.hpp"
#include "transport/runs.hpp"

#include <algorithm>

namespace abbe::transport {

namespace {

/// Surfaces at one place that light may pass one after the other.
constexpr int most_without_way = 4096;

} // namespace

Shadows::Shadows(Stage const& stage, Arena& arena, geometry::Scratch& scratch, SampleFilm& film,
                 MediaStacks& stacks, Paths& paths)
    : stage_(stage),
      arena_(arena),
      scratch_(scratch),
      film_(film),
      stacks_(stacks),
      paths_(paths),
      way_(stage, stacks) {
  fields_.rest = true;
  fields_.travelled = stage.has_priorities;
  fields_.path = paths.records();
}

void Shadows::add(Chunk const& chunk, std::size_t lamp, Aim const& aim, RaySet lit,
                  double const* light) {
  bool const follows = stage_.caustics && stage_.caustics->follows(lamp);
  RaySet apart = 0;
  if (follows && stage_.has_non_collectors)
    each_of(lit, [&](std::size_t r) {
      apart |= RaySet{!stage_.casts[chunk.hit[r].solid].collects} << r;
    });
  if ((lit & ~apart) != 0) add(chunk, {chunk.kind, lamp, follows}, aim, lit & ~apart, light);
  if (apart != 0) add(chunk, {chunk.kind, lamp, false}, aim, apart, light);
}

void Shadows::add(Chunk const& chunk, Key const& key, Aim const& aim, RaySet lit,
                  double const* light) {
  std::size_t const lamp = key.lamp;
  bool const area = stage_.lamps[lamp]->area() != nullptr;
  AreaPoints* const points =
      area ? &areas_.try_emplace(key, chunk.kind, fields_).first->second : nullptr;
  Rays& to = area ? points->rays : queues_.of(key, chunk.kind, fields_);
  std::size_t const count = static_cast<std::size_t>(std::popcount(lit)), n = chunk.each;
  std::size_t const first = to.add(count);
  std::uint8_t ray[chunk_width];
  std::size_t last = 0;
  each_of(lit, [&](std::size_t r) { ray[last++] = static_cast<std::uint8_t>(r); });
  Runs const runs(ray, count);
  runs.take_vectors(chunk.point, to.origin, first);
  runs.take_vectors(chunk.point_error, to.origin_error, first);
  runs.take_vectors(aim.direction, to.direction, first);
  runs.take(chunk.slot, to.slot.data() + first);
  runs.take(aim.distance.value, to.rest.data() + first);
  runs.take(light, to.light_of(first), n);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t const r = ray[i], k = first + i;
    bool const through = glm::dot(chunk.geometric.get(r), aim.direction.get(r)) < 0;
    to.start[k] = chunk.start_of(r, through);
    to.stack[k] = through ? chunk.after[r] : chunk.before[r];
    to.channel[k] = chunk.channels[r * n];
  }
  if (area) points->add(chunk, lamp, *stage_.lamps[lamp], aim, lit);
  if (chunk.kind.listed()) runs.take(chunk.channels, to.channels.data() + first * n, n);
  if (fields_.travelled) std::fill_n(to.travelled.data() + first, count, 0.0);
  if (fields_.path) runs.take(chunk.path, to.path.data() + first);
}

void Shadows::add_to_film(Rays const& rays, std::size_t k) {
  double const* const light = rays.light_of(k);
  if (arrived_ != nullptr) {
    std::size_t const n = rays.kind().size();
    std::copy_n(light, n, arrived_->data() + rays.slot[k] * n);
    return;
  }
  for (std::uint32_t c = 0; c < rays.kind().size(); ++c) {
    film_[rays.slot[k] + c] += light[c];
    if (fields_.path)
      paths_.add(rays.path[k], light[c], film_.is_sample(film_.block_of(rays.slot[k])));
  }
}

std::uint64_t Shadows::finish(geometry::Groups const& groups) {
  std::uint64_t ways = 0;
  queues_.each([&](Key const& key, Rays& rays) {
    finish(rays, *stage_.lamps[key.lamp], key.opaque(), groups);
    rays.clear();
  });
  for (auto& [key, points] : areas_)
    if (points.rays.count() > 0) {
      ways += finish(points, *stage_.lamps[key.lamp], key.opaque(), groups);
      points.clear();
    }
  return ways;
}

void Shadows::finish(Rays& rays, Lamp const& lamp, std::uint8_t opaque,
                     geometry::Groups const& groups) {
  if (lamp.gate() != nullptr) pass_gate(rays, *lamp.gate());
  blocked_.resize(rays.count());
  stage_.world->occluded(rays.lines(groups), opaque, rays.rest.data(), scratch_, blocked_.data());
  if (stage_.has_filter_shadows) {
    std::size_t left = 0;
    for (std::size_t k = 0; k < rays.count(); ++k)
      if (blocked_[k] == 0) rays.move(k, left++);
    rays.keep_first(left);
    return filter(rays, lamp, groups);
  }
  for (std::size_t k = 0; k < rays.count(); ++k) {
    if (blocked_[k] != 0) continue;
    if (lamp.weakened_by_air()) weaken(rays, k, rays.rest[k]);
    add_to_film(rays, k);
  }
}

void Shadows::pass_gate(Rays& rays, geometry::World const& gate) {
  anywhere_.assign(rays.count(), {});
  geometry::RayLines lines = rays.lines(starts_[0]);
  lines.start = anywhere_.data();
  gate.intersect(lines, 0xff, rays.rest.data(), scratch_, hits_);
  std::size_t left = 0;
  for (std::size_t k = 0; k < rays.count(); ++k) {
    bool const met =
        hits_.hit[k].kind != geometry::RayHit::Kind::Nothing && hits_.t[k] < rays.rest[k];
    if (!met) continue;
    rays.move(k, left);
    rays.rest[left++] = hits_.t[k];
  }
  rays.keep_first(left);
}

void Shadows::weaken(Rays& rays, std::size_t k, double distance) {
  if (!(distance > 0) || !stacks_.in_air(rays.stack[k])) return;
  channels_.resize(rays.kind().size());
  channels_of(rays, k, channels_.data());
  Vectors origin, direction;
  origin.set(0, rays.origin.get(k));
  direction.set(0, rays.direction.get(k));
  AirWay const way{rays.kind().size(), 1,      &origin, &direction, &distance, channels_.data(),
                   rays.light_of(k),   nullptr};
  for (auto const& effect : stage_.air) effect->to_lamp(way);
}

Passage Shadows::passage(Rays& rays, std::size_t k, double const* distance) {
  channels_.resize(rays.kind().size());
  channels_of(rays, k, channels_.data());
  return {1, rays.kind().size(), channels_.data(), distance, rays.light_of(k), true};
}

void Shadows::filter(Rays& rays, Lamp const& lamp, geometry::Groups const& groups) {
  geometry::Groups const* from = &groups;
  stuck_.assign(rays.count(), 0);
  for (int turn = 0; rays.count() > 0; turn = 1 - turn) {
    stage_.world->intersect(rays.lines(*from), filter_shadow_bit, rays.rest.data(), scratch_,
                            hits_);
    geometry::Groups& starts = starts_[turn];
    starts.clear();
    std::size_t left = 0;
    for (std::size_t k = 0; k < rays.count(); ++k) {
      // What the lamp lies on, within rounding errors, is not in its way.
      bool const met = hits_.hit[k].kind != geometry::RayHit::Kind::Nothing
                       && hits_.t[k] + hits_.error[k] < rays.rest[k];
      if (!met) {
        arrive(rays, lamp, k);
        continue;
      }
      double const before = rays.rest[k];
      if (!pass(rays, lamp, k, starts)) continue;
      // A ray that passes surface after surface without coming nearer to the lamp goes to and fro
      // between two whose places are less exact than they are apart: it never arrives.
      int const stuck = rays.rest[k] < before ? 0 : stuck_[k] + 1;
      if (stuck > most_without_way) continue;
      stuck_[left] = static_cast<std::uint16_t>(stuck);
      rays.move(k, left++);
    }
    rays.keep_first(left);
    from = &starts;
  }
}

void Shadows::arrive(Rays& rays, Lamp const& lamp, std::size_t k) {
  if (lamp.weakened_by_air()) weaken(rays, k, rays.rest[k]);
  double rest = std::max(rays.rest[k], 0.0);
  double const travelled = fields_.travelled ? rays.travelled[k] : 0;
  if (rays.rest[k] >= 0 && rays.stack[k] != MediaStacks::none) {
    double in_last = rest;
    Passage way = passage(rays, k, &in_last);
    MediaStacks::Id stack = rays.stack[k];
    if (way_.has_stops(stack, false)) {
      geometry::Ray const line{rays.origin.get(k), rays.direction.get(k)};
      auto const end = way_.to_last_stop(line, stack, rest, travelled, way);
      stack = end.stack;
      in_last = end.rest;
    }
    Medium const& medium = stage_.medium(stacks_.medium(stack)); // the lamp stands in it
    Way::along(medium, way);
    rest += travelled;
    way.distance = &rest;
    if (!stacks_.plain(stack)) Way::leave(medium, way);
  }
  add_to_film(rays, k);
}

bool Shadows::pass(Rays& rays, Lamp const& lamp, std::size_t k, geometry::Groups& starts) {
  using Kind = geometry::RayHit::Kind;
  geometry::RayHit& hit = hits_.hit[k];
  geometry::HitGroup* const group =
      hit.kind == Kind::Group ? &hits_.groups[hits_.group[k]] : nullptr;
  double const t = hits_.t[k];
  if (lamp.weakened_by_air()) weaken(rays, k, t);
  double in_last = t;
  Passage way = passage(rays, k, &in_last);
  MediaStacks::Id before = rays.stack[k];
  double const travelled = (fields_.travelled ? rays.travelled[k] : 0);
  if (way_.has_stops(before, false)) {
    geometry::Ray const line{rays.origin.get(k), rays.direction.get(k)};
    auto const end = way_.to_last_stop(line, before, t, travelled, way);
    before = end.stack;
    in_last = end.rest;
  }
  Medium const& medium = stage_.medium(stacks_.medium(before));
  Way::along(medium, way);
  MediaStacks::Id const after =
      group != nullptr ? stacks_.after(before, group->crossings) : stacks_.after(before, hit);
  bool const shown =
      !stage_.has_priorities || drop_displaced(stage_, stacks_, before, after, hit, group);
  double const gone = travelled + t;
  if (int const left = shown ? stacks_.left(before, after) : 0; left != 0) {
    way.distance = &gone;
    Way::leave(stage_.medium(left), way);
  }
  if (fields_.travelled) rays.travelled[k] = shown ? 0 : gone;
  std::size_t const n = rays.kind().size();
  auto const tint = [&](geometry::SurfaceCrossing const& crossing, bool inverse) {
    Vec3 const direction = rays.direction.get(k), point = hits_.point.get(k);
    surface::Reader const reader = stage_.reader();
    reader.tint(
        {crossing, inverse, point, {reader.facing(crossing, point, direction), direction, Vec2(0)}},
        stage_.focus(crossing), {channels_.data(), static_cast<int>(n), rays.light_of(k)}, arena_);
  };
  if (shown && group == nullptr)
    tint({hit.solid, hit.primitive, hit.face, t, hit.entering, hit.toggles},
         hit.was_entering != hit.entering);
  else if (shown)
    for (auto const& crossing : group->crossings)
      tint(crossing, surface::Reader::inverse(*group, crossing));
  if (!any_but_zero(rays.light_of(k), n)) return false;
  rays.rest[k] -= t;
  rays.stack[k] = after;
  rays.origin.set(k, hits_.point.get(k));
  rays.origin_error.set(k, hits_.point_error.get(k));
  if (group == nullptr) {
    rays.start[k] = {hit.primitive, hit.face, geometry::RayStart::Kind::Surface, hit.was_entering,
                     true};
  } else {
    rays.start[k] = {starts.count(), 0, geometry::RayStart::Kind::Group, false, true};
    starts.add().members = group->members;
  }
  if (rays.rest[k] > 0) return true;
  rays.rest[k] = 0;
  arrive(rays, lamp, k);
  return false;
}

} // namespace abbe::transport
