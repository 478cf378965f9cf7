// SPDX-License-Identifier: MIT
#include "geometry/first_end.hpp"
#include "geometry/world_impl.hpp"

#include <algorithm>

/// The questions of single rays: most are answered by one crossing that is clear of all others,
/// which needs no lists.
namespace abbe::geometry {

/// The nearest crossing so far.
struct World::Impl::First {
  double t = everywhere;
  double begin = everywhere, end; ///< of its error interval
  double next = everywhere;       ///< where the first of the other solids' crossings may begin
  Alone& crossing;
  bool alone = true; ///< its only event

  First(double t_max, Alone& out) : end(t_max), crossing(out) {}
  /// Takes its place, or crowds it. @return whether it takes it
  bool propose(double its_t, double its_error) {
    double const its_begin = its_t - its_error;
    if (!(its_begin <= end)) return false;
    if (!(its_t < t)) {
      next = std::min(next, its_begin);
      return false;
    }
    next = std::min(next, begin);
    t = its_t;
    crossing.error = its_error;
    begin = its_begin;
    end = its_t + its_error;
    return true;
  }
  bool single() const { return alone && !(next <= end); }
};

namespace {

lane::Vec<double> vec(Vec3 const& v) {
  return {v.x, v.y, v.z};
}

/// The first end of a solid that is one convex shape. @return false where there is none up to
/// `until`
bool find_end(TracedSolid const& solid, std::vector<Placed> const& primitives, Ray const& ray,
              Departure const* from, double until, FirstEnd<double>& out) {
  Placed const& placed = primitives[solid.only()];
  Start start;
  bool const starts = find_start(from, solid.only(), start);
  // What leaves a convex shape does not come back.
  if (starts ? !start.to_inside : placed.misses(ray, until)) return false;
  Ends<double> ends;
  solid.ends()->ends(placed.line(vec(ray.origin), vec(ray.direction)), starts ? &start : nullptr,
                     ends);
  out = first_end(ends, from != nullptr && !starts);
  return out.valid;
}

} // namespace

World::Impl::Kind World::Impl::first_single(Ray const& ray, Departure const* from,
                                            std::uint8_t mask, double t_max, Scratch& scratch,
                                            Alone& out) const {
  prepare(scratch);
  First first(t_max, out);
  auto const ask_any = [&](SolidId id, TracedSolid const& solid) {
    solid.passages(query(id, ray, from, scratch, first.end), false,
                   [&](TracedSolid::Passage const& passage) {
                     if (!(passage.crossing.t < t_max)) return false;
                     if (passage.crossing.t - passage.error > first.end) return false;
                     if (!passage.visible) return true;
                     if (first.propose(passage.crossing.t, passage.error)) {
                       out.crossing = passage.crossing;
                       out.was_entering = scratch.events[passage.first].entering;
                       first.alone = passage.last - passage.first == 1;
                     }
                     return false;
                   });
  };
  each_solid<NodeProbe>(ray, mask, 0.0, first.end, [&](SolidId id) {
    TracedSolid const& solid = solids[id];
    if ((solid.mask() & mask) == 0) return true;
    if (solid.ends() == nullptr) {
      ask_any(id, solid);
      return true;
    }
    FirstEnd<double> end;
    if (!find_end(solid, primitives, ray, from, first.end, end) || !(end.t < t_max)) return true;
    if (first.propose(end.t, group_margin * end.error)) {
      out.crossing = {id,
                      solid.only(),
                      static_cast<std::uint32_t>(end.face),
                      end.t,
                      end.enters != solid.inverse(),
                      true};
      out.was_entering = end.enters;
      first.alone = true;
    }
    return true;
  });
  if (!(first.t < everywhere)) return Kind::Nothing;
  return first.single() ? Kind::Single : Kind::Several;
}

bool World::closest(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                    Scratch& scratch, HitGroup& out) const {
  Impl::Alone alone;
  Impl::Kind const kind = impl_->first_single(ray, from, mask, t_max, scratch, alone);
  if (kind == Impl::Kind::Nothing) return false;
  if (kind == Impl::Kind::Several) {
    impl_->first_group(ray, from, mask, t_max, scratch, out);
  } else {
    out.clear();
    out.t = alone.crossing.t;
    out.error = alone.error;
    set_point(ray.origin, ray.direction, out.t, out.error, out.point, out.point_error);
    out.crossings.push_back(alone.crossing);
    out.members.push_back({alone.crossing.primitive, alone.crossing.face, alone.was_entering});
  }
  if (impl_->contacts.any()) impl_->join_contact(ray, mask, t_max, scratch, out);
  return true;
}

bool World::Impl::closest_group(Ray const& ray, Departure const* from, std::uint8_t mask,
                                double t_max, Scratch& scratch, HitGroup& out) const {
  prepare(scratch);
  if (!first_group(ray, from, mask, t_max, scratch, out)) return false;
  if (contacts.any()) join_contact(ray, mask, t_max, scratch, out);
  return true;
}

bool World::Impl::occluded(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                           Scratch& scratch) const {
  prepare(scratch);
  auto const blocks = [&](SolidId id, TracedSolid const& solid) {
    if (solid.ends() != nullptr) {
      FirstEnd<double> end;
      return find_end(solid, primitives, ray, from, t_max, end)
             && end.t + group_margin * end.error < t_max;
    }
    bool found = false;
    solid.passages(query(id, ray, from, scratch, t_max), false,
                   [&](TracedSolid::Passage const& passage) {
                     if (passage.crossing.t + passage.error >= t_max) return false;
                     found = passage.visible;
                     return !found;
                   });
    return found;
  };
  bool found = false;
  auto const ask = [&](SolidId id) {
    TracedSolid const& solid = solids[id];
    if ((solid.mask() & mask) == 0) return true;
    found = blocks(id, solid);
    if (found) scratch.last_occluder = id;
    return !found;
  };
  // Neighbouring rays meet the same.
  SolidId const last = scratch.last_occluder;
  if (last < solids.size() && !ask(last)) return true;
  each_solid<NodeProbe>(ray, mask, 0.0, t_max, [&](SolidId id) { return id == last || ask(id); });
  if (!found) scratch.last_occluder = no_solid;
  return found;
}

bool World::occluded(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                     Scratch& scratch) const {
  return impl_->occluded(ray, from, mask, t_max, scratch);
}

} // namespace abbe::geometry
