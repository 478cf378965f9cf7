// SPDX-License-Identifier: MIT
#include "geometry/fan.hpp"

#include "geometry/fan_cut.hpp"
#include "geometry/fan_probe.hpp"
#include "geometry/first_end.hpp"
#include "geometry/registers.hpp"
#include "geometry/world_impl.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

void FanLines::copy(std::size_t to, FanLines const& from, std::size_t k) {
  origin.set(to, from.origin.get(k));
  direction.set(to, from.direction.get(k));
  origin_error.set(to, from.origin_error.get(k));
}

void FanLines::fill() {
  for (std::size_t k = count; k % 4 != 0; ++k) copy(k, *this, count - 1);
}

void FanHits::copy(std::size_t to, FanHits const& from, std::size_t k) {
  hit[to] = from.hit[k];
  t[to] = from.t[k];
  error[to] = from.error[k];
  point.set(to, from.point.get(k));
  point_error.set(to, from.point_error.get(k));
}

void FanHits::write(std::size_t k, HitGroup& out) const {
  out.clear();
  out.t = t[k];
  out.error = error[k];
  out.point = point.get(k);
  out.point_error = point_error.get(k);
  FanHit const& h = hit[k];
  out.crossings.push_back({h.solid, h.primitive, h.face, t[k], h.entering, h.toggles});
  out.members.push_back({h.primitive, h.face, h.was_entering});
}

/// The rays' nearest crossings so far. What is kept of the surface is the number of its proposal.
struct World::Impl::Nearest {
  alignas(32) double t[fan_width], begin[fan_width], end[fan_width], error[fan_width];
  alignas(32) double next[fan_width]; ///< where the first of the other crossings may begin
  alignas(32) double face[fan_width], entering[fan_width], proposal[fan_width];

  alignas(32) double until[fan_width];

  Nearest(std::size_t count, double const* t_max) {
    for (std::size_t k = 0; k < (count + 3) / 4 * 4; ++k) {
      until[k] = t_max == nullptr ? everywhere : t_max[std::min(k, count - 1)];
      t[k] = begin[k] = next[k] = everywhere;
      end[k] = until[k];
      error[k] = face[k] = entering[k] = 0;
      proposal[k] = -1;
    }
  }
  double farthest(std::size_t count) const { return *std::max_element(end, end + count); }
};

namespace {

using Nearest = World::Impl::Nearest;

struct Query {
  FanLines const& rays;
  Departure const* from;
  Scratch& scratch;
  Nearest& nearest;
  std::vector<FanProposal>& proposals;
};

/// A crossing that begins before the nearest's interval ends takes its place, or crowds it.
template <class L, class M>
void propose(Nearest& nearest, std::size_t at, M const& valid, L const& t, L const& error,
             L const& face, L const& entering, double number) {
  using lane::load, lane::select, lane::store;
  L const begin = t - error, best_t = load<L>(nearest.t + at);
  auto const counts = lane::both(lane::both(valid, t < load<L>(nearest.until + at)),
                                 begin <= load<L>(nearest.end + at));
  if (lane::none(counts)) return;
  auto const nearer = lane::both(counts, t < best_t);
  L const old_begin = load<L>(nearest.begin + at), next = load<L>(nearest.next + at);
  L const crowding = lane::min(next, select(nearer, old_begin, begin));
  store(nearest.next + at, select(counts, crowding, next));
  auto const keep = [&](double* to, L const& value) {
    store(to + at, select(nearer, value, load<L>(to + at)));
  };
  keep(nearest.t, t);
  keep(nearest.begin, begin);
  keep(nearest.end, t + error);
  keep(nearest.error, error);
  keep(nearest.face, face);
  keep(nearest.entering, entering);
  keep(nearest.proposal, L(number));
}

template <class L>
lane::Vec<L> load(FanVectors const& v, std::size_t at) {
  return {lane::load<L>(v.x + at), lane::load<L>(v.y + at), lane::load<L>(v.z + at)};
}

/// A convex shape that is a solid by itself: its first end after the start.
template <class L>
void propose_convex(Query const& query, Placed const& placed, EndsKernel const& shape,
                    Start const* start, double number) {
  FanLines const& rays = query.rays;
  lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t at) {
    Ends<Lanes> ends;
    shape.ends(placed.line<Lanes>(load<Lanes>(rays.origin, at), load<Lanes>(rays.direction, at)),
               start, ends);
    FirstEnd<Lanes> const first = first_end(ends, start == nullptr && query.from != nullptr);
    if (lane::none(first.valid)) return;
    propose<Lanes>(query.nearest, at, first.valid, first.t, Lanes(group_margin) * first.error,
                   first.face, lane::select(first.enters, Lanes(1.0), Lanes(0.0)), number);
  });
}

/// Any solid, for one ray.
void propose_any(Query const& query, World::Impl const& world, SolidId id, std::size_t k) {
  Bounds const& bounds = world.solids[id].bounds();
  double const& end = query.nearest.end[k];
  Ray const ray = query.rays.get(k);
  double entry = 0;
  if (!bounds.infinite && !BoxProbe(ray).enter(bounds.low, bounds.high, 0, end, entry)) return;
  world.solids[id].passages(
      world.query(id, ray, query.from, query.scratch, end), false,
      [&](TracedSolid::Passage const& passage) {
        SurfaceCrossing const& crossing = passage.crossing;
        if (crossing.t - passage.error > end) return false;
        if (!passage.visible) return true;
        bool const was_entering = query.scratch.events[passage.first].entering;
        query.proposals.push_back({id, crossing.primitive, crossing.entering != was_entering,
                                   passage.last - passage.first == 1, crossing.toggles});
        propose<double>(query.nearest, k, true, crossing.t, passage.error, crossing.face,
                        was_entering ? 1.0 : 0.0, static_cast<double>(query.proposals.size() - 1));
        return false;
      });
}

/// The intersection of convex operands: the first end after the start of some of the rays.
template <class L>
void propose_cut_at(Query const& query, World::Impl const& world, SolidId id, ConvexCut const& cut,
                    CutDeparture const& departure, std::size_t at) {
  L const zero(0.0), one(1.0), far(infinity);
  FanLines const& rays = query.rays;
  HalfSpaces const& planes = cut.planes();
  std::vector<FanProposal>& proposals = query.proposals;
  constexpr std::size_t width = lane::width<L>;
  std::size_t const lanes = std::min(width, rays.count - at);
  LaneRays<L> const lines{load<L>(rays.origin, at), load<L>(rays.direction, at),
                          load<L>(rays.origin_error, at)};
  CutEnd<L> const first = first_end_of<L>(cut, world.primitives, lines, query.from, departure);
  alignas(64) double unclear[width], place[width];
  lane::store(unclear, lane::select(first.unclear, one, zero));
  lane::store(place, lane::select(first.found, first.place, -one));
  for (std::size_t k = 0; k < lanes; ++k) {
    if (unclear[k] != 0) propose_any(query, world, id, at + k);
    double const own = place[k];
    bool const known = !(own >= 0) || std::find(place, place + k, own) != place + k;
    if (known) continue; // nothing, or an earlier lane has asked for all
    auto const here = lane::both(first.found, first.place == L(own));
    double const number = static_cast<double>(proposals.size());
    auto const i = static_cast<std::size_t>(own);
    if (i >= planes.count()) {
      proposals.push_back({id, cut.others()[i - planes.count()].primitive, false, true, true});
      propose<L>(query.nearest, at, here, first.t, first.error, first.face,
                 lane::select(first.enters, one, zero), number);
      continue;
    }
    PrimitiveId const primitive = planes.primitives()[i];
    Placed const& placed = world.primitives[primitive];
    Ends<L> ends;
    placed.shape().ends_kernel()->ends(placed.line<L>(lines.origin, lines.direction), nullptr,
                                       ends);
    auto const entering = -far < ends.in_t; // one of the two is infinite
    L const t = lane::select(entering, ends.in_t, ends.out_t);
    L const error = lane::select(entering, ends.in_error, ends.out_error);
    proposals.push_back({id, primitive, planes.outside_counts(i), true, true});
    propose<L>(query.nearest, at, lane::both(here, lane::abs(t) < far), t, L(group_margin) * error,
               zero, lane::select(entering, one, zero), number);
  }
}
template <class L>
void propose_cut(Query const& query, World::Impl const& world, SolidId id, ConvexCut const& cut) {
  CutDeparture const departure = departure_of(cut.planes(), query.from);
  if (departure.unclear) {
    for (std::size_t k = 0; k < query.rays.count; ++k) propose_any(query, world, id, k);
    return;
  }
  lane::in_lanes<L>(query.rays.count, [&]<class Lanes>(std::size_t at) {
    propose_cut_at<Lanes>(query, world, id, cut, departure, at);
  });
}

/// set_point() for all rays; without meaning for those that met nothing.
template <class L>
void find_points(FanLines const& rays, Nearest const& nearest, FanHits& out) {
  lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t at) {
    auto const t = lane::load<Lanes>(nearest.t + at), error = lane::load<Lanes>(nearest.error + at);
    lane::store(out.t + at, t);
    lane::store(out.error + at, error);
    auto const along = [&](double const* origin, double const* direction, double* point,
                           double* point_error) {
      auto const d = lane::load<Lanes>(direction + at), step = t * d;
      auto const p = lane::load<Lanes>(origin + at) + step;
      lane::store(point + at, p);
      lane::store(point_error + at,
                  lane::abs(d) * error + Lanes(gamma_bound(2)) * (lane::abs(step) + lane::abs(p)));
    };
    along(rays.origin.x, rays.direction.x, out.point.x, out.point_error.x);
    along(rays.origin.y, rays.direction.y, out.point.y, out.point_error.y);
    along(rays.origin.z, rays.direction.z, out.point.z, out.point_error.z);
  });
}

/// What is known of the surfaces.
void write_hits(std::size_t count, Nearest const& nearest,
                std::vector<FanProposal> const& proposals, FanHits& out) {
  for (std::size_t k = 0; k < count; ++k) {
    FanHit& hit = out.hit[k];
    hit = {};
    if (nearest.proposal[k] < 0) continue;
    FanProposal const& proposal = proposals[static_cast<std::size_t>(nearest.proposal[k])];
    // Crossings of other solids within the error of the nearest make a group.
    bool const single = proposal.alone && !(nearest.next[k] <= nearest.end[k]);
    if (!single) {
      hit.kind = FanHit::Kind::Unclear;
      continue;
    }
    hit.kind = FanHit::Kind::Single;
    hit.was_entering = nearest.entering[k] != 0;
    hit.entering = hit.was_entering != proposal.inverse;
    hit.toggles = proposal.toggles;
    hit.solid = proposal.solid;
    hit.primitive = proposal.primitive;
    hit.face = static_cast<std::uint32_t>(nearest.face[k]);
  }
}

/// The functions for the registers that the machine has.
struct Kernels {
  void (*convex)(Query const&, Placed const&, EndsKernel const&, Start const*, double);
  void (*cut)(Query const&, World::Impl const&, SolidId, ConvexCut const&);
  void (*points)(FanLines const&, Nearest const&, FanHits&);
  FanExtents (*extents)(FanLines const&);
};
using lane::Double4;
constexpr Kernels narrow_kernels = {propose_convex<Double4>, propose_cut<Double4>,
                                    find_points<Double4>, extents_of<Double4>};
#if ABBE_HAS_WIDE_LANES
using lane::Wide4, lane::Wide8;
ABBE_FOR_AVX2 void propose_convex_wide(Query const& query, Placed const& placed,
                                       EndsKernel const& shape, Start const* start, double number) {
  propose_convex<Wide4>(query, placed, shape, start, number);
}
ABBE_FOR_AVX2 void propose_cut_wide(Query const& query, World::Impl const& world, SolidId id,
                                    ConvexCut const& cut) {
  propose_cut<Wide4>(query, world, id, cut);
}
ABBE_FOR_AVX2 void find_points_wide(FanLines const& rays, Nearest const& nearest, FanHits& out) {
  find_points<Wide4>(rays, nearest, out);
}
ABBE_FOR_AVX2 FanExtents extents_wide(FanLines const& rays) {
  return extents_of<Wide4>(rays);
}
ABBE_FOR_AVX512 void propose_convex_widest(Query const& query, Placed const& placed,
                                           EndsKernel const& shape, Start const* start,
                                           double number) {
  propose_convex<Wide8>(query, placed, shape, start, number);
}
ABBE_FOR_AVX512 void propose_cut_widest(Query const& query, World::Impl const& world, SolidId id,
                                        ConvexCut const& cut) {
  propose_cut<Wide8>(query, world, id, cut);
}
ABBE_FOR_AVX512 void find_points_widest(FanLines const& rays, Nearest const& nearest,
                                        FanHits& out) {
  find_points<Wide8>(rays, nearest, out);
}
Kernels const native = for_registers<Kernels>(
    narrow_kernels, {propose_convex_wide, propose_cut_wide, find_points_wide, extents_wide},
    {propose_convex_widest, propose_cut_widest, find_points_widest, extents_wide});
#else
Kernels const native = narrow_kernels;
#endif

} // namespace

void World::Impl::find_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                           Scratch& scratch, Nearest& nearest) const {
  prepare(scratch);
  scratch.proposals.clear();
  Query const query{rays, from, scratch, nearest, scratch.proposals};
  double farthest = nearest.farthest(rays.count);
  each_solid<FanProbe>(native.extents(rays), mask, 0.0, farthest, [&](SolidId id) {
    TracedSolid const& solid = solids[id];
    if ((solid.mask() & mask) == 0) return true;
    if (EndsKernel const* const shape = solid.ends()) {
      Start start;
      bool const starts = find_start(from, solid.only(), start);
      query.proposals.push_back({id, solid.only(), solid.inverse(), true, true});
      native.convex(query, primitives[solid.only()], *shape, starts ? &start : nullptr,
                    static_cast<double>(query.proposals.size() - 1));
    } else if (ConvexCut const* const cut = solid.fan_cut()) {
      native.cut(query, *this, id, *cut);
    } else {
      for (std::size_t k = 0; k < rays.count; ++k) propose_any(query, *this, id, k);
    }
    farthest = nearest.farthest(rays.count);
    return true;
  });
}

void World::closest_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                        double const* t_max, Scratch& scratch, FanHits& hits) const {
  Impl::Nearest nearest(rays.count, t_max);
  impl_->find_fan(rays, from, mask, scratch, nearest);
  native.points(rays, nearest, hits);
  write_hits(rays.count, nearest, scratch.proposals, hits);
  if (!impl_->contacts.any()) return;
  for (std::size_t k = 0; k < rays.count; ++k) {
    FanHit& hit = hits.hit[k];
    bool const leaves = hit.kind == FanHit::Kind::Single && !hit.entering && hit.toggles;
    if (leaves && impl_->contacts.reach(hit.solid) > 0) hit.kind = FanHit::Kind::Unclear;
  }
}

void World::occluded_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                         double const* t_max, Scratch& scratch, bool* blocked, bool* clear) const {
  Impl::Nearest nearest(rays.count, t_max);
  impl_->find_fan(rays, from, mask, scratch, nearest);
  for (std::size_t k = 0; k < rays.count; ++k) {
    clear[k] = nearest.proposal[k] < 0;
    blocked[k] = !clear[k] && nearest.end[k] < t_max[k];
  }
}

bool World::flat(PrimitiveId id, std::uint32_t face) const {
  return impl_->primitives[id].shape().flat(face);
}

} // namespace abbe::geometry
