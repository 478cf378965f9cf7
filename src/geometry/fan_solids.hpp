// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan_cut.hpp"
#include "geometry/first_end.hpp"
#include "geometry/lane_tree.hpp"
#include "geometry/world_impl.hpp"

#include <algorithm>

/// How solids of each kind are asked for the rays of a fan; for fan.cpp alone, which compiles these
/// templates for each kind of registers.
namespace abbe::geometry {

/// The nearest crossing, and the one that is in a group with it.
struct World::Impl::Pair {
  SurfaceCrossing crossing[2];
  double error[2];
  bool was_entering[2];
};

/// The rays' nearest crossings so far. What is kept of the surface is the number of its proposal.
struct World::Impl::Nearest {
  /// A crossing of each ray.
  struct Crossing {
    alignas(32) double t[fan_width], error[fan_width];
    alignas(32) double face[fan_width], entering[fan_width], proposal[fan_width];
  };
  Crossing first;
  alignas(32) double begin[fan_width], end[fan_width]; ///< of its error interval
  /// Of the others that were within the error of the first when they were met, that which begins
  /// first; `second_begin` tells whether there is one.
  Crossing second;
  alignas(32) double second_begin[fan_width];
  alignas(32) double third_begin[fan_width]; ///< of all others
  alignas(32) double after[fan_width]; ///< no solid has another crossing that begins before this
  alignas(32) double until[fan_width];

  /// It is only asked whether anything is in the way: of `first`, the proposal says that something
  /// may be, and `end` is -infinity where something is.
  bool only_blocked;

  Nearest(std::size_t count, double const* t_max, bool only_whether = false)
      : only_blocked(only_whether) {
    for (std::size_t k = 0; k < (count + 3) / 4 * 4; ++k) {
      until[k] = end[k] = t_max == nullptr ? everywhere : t_max[std::min(k, count - 1)];
      first.proposal[k] = -1;
      if (only_blocked) continue;
      first.t[k] = begin[k] = everywhere;
      second_begin[k] = third_begin[k] = after[k] = everywhere;
      first.error[k] = first.face[k] = first.entering[k] = 0;
    }
  }
  bool blocked(std::size_t k) const { return end[k] == -everywhere; }
  bool found(std::size_t k) const { return !(first.proposal[k] < 0); }
  /// Crossings of other solids within the error of the first make a group.
  bool single(std::size_t k) const {
    return !(second_begin[k] <= end[k]) && !(third_begin[k] <= end[k]);
  }
  /// Is that group of the two alone, whichever counts as the first?
  bool pair(std::size_t k) const {
    double const last = std::max(end[k], second.t[k] + second.error[k]);
    return second_begin[k] <= end[k] && !(third_begin[k] <= last) && !(after[k] <= last);
  }
  double farthest(std::size_t count) const { return *std::max_element(end, end + count); }
};

using FanNearest = World::Impl::Nearest;

struct FanQuery {
  FanLines const& rays;
  Departure const* from;
  Scratch& scratch;
  FanNearest& nearest;
  std::vector<FanProposal>& proposals;
};

/// A crossing that begins before the nearest's interval ends takes its place, or crowds it.
/// @param after where the solid's next one begins, or before
template <class L, class M>
void propose(FanNearest& nearest, std::size_t at, M const& valid, L const& t, L const& error,
             L const& face, L const& entering, L const& after, double number) {
  using lane::load, lane::select, lane::store;
  L const begin = t - error, until = load<L>(nearest.until + at);
  L const old_end = load<L>(nearest.end + at);
  auto const counts = lane::both(lane::both(valid, t < until), begin <= old_end);
  if (lane::none(counts)) return;
  if (nearest.only_blocked) {
    store(nearest.end + at, select(lane::both(counts, t + error < until), L(-everywhere), old_end));
    store(nearest.first.proposal + at,
          select(counts, L(number), load<L>(nearest.first.proposal + at)));
    return;
  }
  L const best_t = load<L>(nearest.first.t + at);
  auto const nearer = lane::both(counts, t < best_t);
  L const old_begin = load<L>(nearest.begin + at), end = select(nearer, t + error, old_end);
  L const lost_begin = select(nearer, old_begin, begin);
  L third = load<L>(nearest.third_begin + at);
  auto crowds = lane::both(counts, lost_begin <= end);
  if (!lane::none(crowds)) { // few rays
    L const second = load<L>(nearest.second_begin + at);
    crowds = lane::both(crowds, lost_begin < second);
    third = select(crowds, lane::min(third, second), third);
    store(nearest.second_begin + at, select(crowds, lost_begin, second));
    auto const keep = [&](double* to, double const* first, L const& value) {
      store(to + at, select(crowds, select(nearer, load<L>(first + at), value), load<L>(to + at)));
    };
    keep(nearest.second.t, nearest.first.t, t);
    keep(nearest.second.error, nearest.first.error, error);
    keep(nearest.second.face, nearest.first.face, face);
    keep(nearest.second.entering, nearest.first.entering, entering);
    keep(nearest.second.proposal, nearest.first.proposal, L(number));
  }
  auto const aside = lane::both(counts, lane::negate(crowds));
  store(nearest.third_begin + at, select(aside, lane::min(third, lost_begin), third));
  L const old_after = load<L>(nearest.after + at);
  store(nearest.after + at, select(counts, lane::min(old_after, after), old_after));
  store(nearest.end + at, end);
  auto const keep = [&](double* to, L const& value) {
    store(to + at, select(nearer, value, load<L>(to + at)));
  };
  keep(nearest.first.t, t);
  keep(nearest.begin, begin);
  keep(nearest.first.error, error);
  keep(nearest.first.face, face);
  keep(nearest.first.entering, entering);
  keep(nearest.first.proposal, L(number));
}

template <class L>
lane::Vec<L> load(FanVectors const& v, std::size_t at) {
  return {lane::load<L>(v.x + at), lane::load<L>(v.y + at), lane::load<L>(v.z + at)};
}

/// A convex shape that is a solid by itself: its first end after the start.
template <class L>
void propose_convex(FanQuery const& query, Placed const& placed, EndsKernel const& shape,
                    Start const* start, double number) {
  FanLines const& rays = query.rays;
  lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t at) {
    Ends<Lanes> ends;
    shape.ends(placed.line<Lanes>(load<Lanes>(rays.origin, at), load<Lanes>(rays.direction, at)),
               start, ends);
    FirstEnd<Lanes> const first = first_end(ends, start == nullptr && query.from != nullptr);
    if (lane::none(first.valid)) return;
    Lanes const leaves = ends.out_t - Lanes(group_margin) * ends.out_error;
    propose<Lanes>(query.nearest, at, first.valid, first.t, Lanes(group_margin) * first.error,
                   first.face, lane::select(first.enters, Lanes(1.0), Lanes(0.0)),
                   lane::select(first.enters, leaves, Lanes(infinity)), number);
  });
}

/// Any solid, for one ray.
inline void propose_any(FanQuery const& query, World::Impl const& world, SolidId id,
                        std::size_t k) {
  Bounds const bounds = world.bounds(id);
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
        // Its next one is not asked for.
        propose<double>(query.nearest, k, true, crossing.t, passage.error, crossing.face,
                        was_entering ? 1.0 : 0.0, crossing.t - passage.error,
                        static_cast<double>(query.proposals.size() - 1));
        return false;
      });
}

/// What lanes from `at` on find of a solid: `ask(place)` once for each place that a lane has, all
/// of those that are unclear one by one.
template <class L, class Ask>
void propose_places(FanQuery const& query, World::Impl const& world, SolidId id, std::size_t at,
                    decltype(L() < L()) const& unclear, decltype(L() < L()) const& found,
                    L const& places, Ask const& ask) {
  constexpr std::size_t width = lane::width<L>;
  L const zero(0.0), one(1.0);
  alignas(64) double alone[width], place[width];
  lane::store(alone, lane::select(unclear, one, zero));
  lane::store(place, lane::select(found, places, -one));
  std::size_t const lanes = std::min(width, query.rays.count - at);
  for (std::size_t k = 0; k < lanes; ++k) {
    if (alone[k] != 0) propose_any(query, world, id, at + k);
    double const own = place[k];
    bool const known = !(own >= 0) || std::find(place, place + k, own) != place + k;
    if (!known) ask(static_cast<std::size_t>(own)); // else nothing, or an earlier lane has
  }
}

template <class L>
LaneRays<L> lines_at(FanLines const& rays, std::size_t at) {
  return {load<L>(rays.origin, at), load<L>(rays.direction, at), load<L>(rays.origin_error, at)};
}

/// The intersection of convex operands: the first end after the start of some of the rays.
template <class L>
void propose_cut_at(FanQuery const& query, World::Impl const& world, SolidId id,
                    ConvexCut const& cut, CutDeparture const& departure, PlaneList const* listed,
                    std::size_t at) {
  L const zero(0.0), one(1.0), far(infinity);
  HalfSpaces const& planes = cut.planes();
  std::vector<FanProposal>& proposals = query.proposals;
  LaneRays<L> const lines = lines_at<L>(query.rays, at);
  CutEnd<L> const first =
      first_end_of<L>(cut, world.primitives, lines, query.from, departure, listed);
  auto const ask = [&](std::size_t i) {
    auto const here = lane::both(first.found, first.place == L(static_cast<double>(i)));
    double const number = static_cast<double>(proposals.size());
    if (i >= planes.count()) {
      proposals.push_back({id, cut.others()[i - planes.count()].primitive, false, true, true});
      propose<L>(query.nearest, at, here, first.t, first.error, first.face,
                 lane::select(first.enters, one, zero), first.after, number);
      return;
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
               zero, lane::select(entering, one, zero), first.after, number);
  };
  propose_places<L>(query, world, id, at, first.unclear, first.found, first.place, ask);
}
template <class L>
void propose_cut(FanQuery const& query, World::Impl const& world, SolidId id,
                 ConvexCut const& cut) {
  CutDeparture const departure = departure_of(cut.planes(), query.from);
  if (departure.unclear) {
    for (std::size_t k = 0; k < query.rays.count; ++k) propose_any(query, world, id, k);
    return;
  }
  HalfSpaces const& planes = cut.planes();
  bool const filters = planes.count() >= PlaneList::least && planes.count() <= PlaneList::most;
  PlaneList listed;
  std::size_t const step = filters ? filter_rays : query.rays.count;
  for (std::size_t first = 0; first < query.rays.count; first += step) {
    if (filters)
      list_planes<typename lane::FloatsOf<L>::Type>(planes, query.rays, query.from, departure,
                                                    first, listed);
    lane::in_lanes<L>(std::min(step, query.rays.count - first), [&]<class Lanes>(std::size_t at) {
      propose_cut_at<Lanes>(query, world, id, cut, departure, filters ? &listed : nullptr,
                            first + at);
    });
  }
}

/// Any boolean tree that lane_tree.hpp can be asked of.
template <class L>
void propose_tree(FanQuery const& query, World::Impl const& world, SolidId id, LaneTree const& tree,
                  TreeOperands const& operands) {
  lane::in_lanes<L>(query.rays.count, [&]<class Lanes>(std::size_t at) {
    Lanes const zero(0.0), one(1.0);
    TreeEnd<Lanes> const first =
        first_end_of<Lanes>(tree, operands, world.primitives, lines_at<Lanes>(query.rays, at),
                            query.from != nullptr, lane::load<Lanes>(query.nearest.end + at));
    Lanes const enters = lane::select(first.enters, one, zero);
    auto const straight = enters == lane::select(first.entered, one, zero);
    propose_places<Lanes>(
        query, world, id, at, first.unclear, first.found, first.operand, [&](std::size_t i) {
          auto const here = lane::both(first.found, first.operand == Lanes(static_cast<double>(i)));
          auto const take = [&](auto const& mask, bool inverse) {
            if (lane::none(mask)) return;
            double const number = static_cast<double>(query.proposals.size());
            query.proposals.push_back({id, tree.operands()[i].primitive, inverse, true, true});
            propose<Lanes>(query.nearest, at, mask, first.t, first.error, first.face, enters,
                           first.after, number);
          };
          take(lane::both(here, straight), false);
          take(lane::both(here, lane::negate(straight)), true);
        });
  });
}

} // namespace abbe::geometry
