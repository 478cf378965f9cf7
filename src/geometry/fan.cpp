// SPDX-License-Identifier: MIT
#include "geometry/fan.hpp"

#include "geometry/fan_probe.hpp"
#include "geometry/fan_solids.hpp"
#include "simd/native.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace abbe::geometry {

void FanLines::copy(std::size_t to, FanLines const& from, std::size_t k) {
  origin.set(to, from.origin.get(k));
  direction.set(to, from.direction.get(k));
  origin_error.set(to, from.origin_error.get(k));
}

void FanLines::fill() {
  for (std::size_t k = count; k % 4 != 0; ++k) copy(k, *this, count - 1);
}

namespace {

/// set_point() for all rays; without meaning for those that met nothing.
struct FindPoints {
  template <class L>
  static void run(FanLines const& rays, FanNearest const& nearest, FanVectors& point,
                  FanVectors& point_error) {
    lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t at) {
      auto const t = lane::load<Lanes>(nearest.first.t + at),
                 error = lane::load<Lanes>(nearest.first.error + at);
      auto const along = [&](double const* origin, double const* direction, double* place,
                             double* place_error) {
        auto const d = lane::load<Lanes>(direction + at), step = t * d;
        auto const p = lane::load<Lanes>(origin + at) + step;
        lane::store(place + at, p);
        lane::store(place_error + at,
                    lane::abs(d) * error
                        + Lanes(gamma_bound(2)) * (lane::abs(step) + lane::abs(p)));
      };
      along(rays.origin.x, rays.direction.x, point.x, point_error.x);
      along(rays.origin.y, rays.direction.y, point.y, point_error.y);
      along(rays.origin.z, rays.direction.z, point.z, point_error.z);
    });
  }
};

FanProposal const& proposal_of(Scratch const& scratch, FanNearest::Crossing const& found,
                               std::size_t k) {
  return scratch.proposals[static_cast<std::size_t>(found.proposal[k])];
}
RayHit single_of(FanProposal const& proposal, FanNearest::Crossing const& found, std::size_t k) {
  bool const entering = found.entering[k] != 0;
  return {RayHit::Kind::Single,
          entering != proposal.inverse,
          proposal.toggles,
          entering,
          proposal.solid,
          proposal.primitive,
          static_cast<std::uint32_t>(found.face[k])};
}
World::Impl::Pair pair_of(Scratch const& scratch, FanNearest const& nearest, std::size_t k) {
  World::Impl::Pair pair;
  FanNearest::Crossing const* const found[] = {&nearest.first, &nearest.second};
  for (std::size_t i = 0; i < 2; ++i) {
    RayHit const hit = single_of(proposal_of(scratch, *found[i], k), *found[i], k);
    pair.crossing[i] = {hit.solid,      hit.primitive, hit.face,
                        found[i]->t[k], hit.entering,  hit.toggles};
    pair.error[i] = found[i]->error[k];
    pair.was_entering[i] = hit.was_entering;
  }
  return pair;
}

struct ProposeConvex {
  template <class L>
  static void run(FanQuery const& query, Placed const& placed, EndsKernel const& shape,
                  Start const* start, double number) {
    propose_convex<L>(query, placed, shape, start, number);
  }
};
struct ProposeCut {
  template <class L>
  static void run(FanQuery const& query, World::Impl const& world, SolidId id,
                  ConvexCut const& cut) {
    propose_cut<L>(query, world, id, cut);
  }
};
struct ProposeTree {
  template <class L>
  static void run(FanQuery const& query, World::Impl const& world, SolidId id, LaneTree const& tree,
                  TreeOperands const& operands) {
    propose_tree<L>(query, world, id, tree, operands);
  }
};
struct FindExtents {
  template <class L>
  static FanExtents run(FanLines const& rays) {
    return extents_of<L>(rays);
  }
};
struct {
  simd::Native<ProposeConvex> convex;
  simd::Native<ProposeCut> cut;
  simd::Native<ProposeTree> tree;
  simd::Native<FindPoints> points;
  simd::Native<FindExtents, 4> extents;
} constexpr native;

} // namespace

void World::Impl::find_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                           Scratch& scratch, Nearest& nearest) const {
  prepare(scratch);
  scratch.proposals.clear();
  FanQuery const query{rays, from, scratch, nearest, scratch.proposals};
  double farthest = nearest.farthest(rays.count);
  FanExtents const extents = native.extents(rays);
  std::optional<FanProbe> operand_probe; // what is at the start by its error must not be left out
  each_solid<FanNodeProbe>(extents, mask, 0.0, farthest, [&](SolidId id) {
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
    } else if (LaneTree const* const tree = solid.lane_tree()) {
      if (!operand_probe) operand_probe.emplace(extents.widened(rays));
      auto const misses = [&](LaneTree::Operand const& operand) {
        Bounds const& bounds = operand.bounds;
        double entry = 0;
        return bounds.empty() || !operand_probe->enter(bounds.low, bounds.high, 0, farthest, entry);
      };
      TreeOperands operands;
      if (operands.find(*tree, from, misses)) {
        if (operands.count > 0) native.tree(query, *this, id, *tree, operands);
      } else {
        for (std::size_t k = 0; k < rays.count; ++k) propose_any(query, *this, id, k);
      }
    } else {
      for (std::size_t k = 0; k < rays.count; ++k) propose_any(query, *this, id, k);
    }
    farthest = nearest.farthest(rays.count);
    return farthest > -everywhere;
  });
}

/// What leaves a solid with partners is clear when there is nothing as near behind it as they
/// reach.
void World::Impl::find_contacts(FanLines const& rays, std::uint32_t const* place, std::uint8_t mask,
                                double const* t_max, Scratch& scratch, Hits const& hits,
                                bool* touches) const {
  bool open[fan_width];
  for (std::size_t k = 0; k < rays.count; ++k) {
    RayHit const& hit = hits.hit[place[k]];
    bool const leaves = hit.kind == RayHit::Kind::Single && !hit.entering && hit.toggles;
    open[k] = leaves && contacts.reach(hit.solid) > 0;
  }
  for (std::size_t first = 0; first < rays.count; ++first) {
    if (!open[first]) continue;
    RayHit const& surface = hits.hit[place[first]];
    double const widest = contacts.reach(surface.solid);
    FanLines behind;
    double reach[fan_width];
    std::size_t own[fan_width];
    behind.count = 0;
    for (std::size_t k = first; k < rays.count; ++k) {
      if (!open[k] || !(hits.hit[place[k]] == surface)) continue;
      open[k] = false;
      Vec3 const point = hits.point.get(place[k]), direction = rays.direction.get(k);
      Vec3 const normal = primitives[surface.primitive].normal(surface.face, point, true);
      double const room = t_max == nullptr ? everywhere : t_max[k] - hits.t[place[k]];
      reach[behind.count] = std::min(widest / std::fabs(glm::dot(direction, normal)), room);
      own[behind.count] = k;
      behind.origin.set(behind.count, point);
      behind.direction.set(behind.count, direction);
      behind.origin_error.set(behind.count, hits.point_error.get(place[k]));
      ++behind.count;
    }
    behind.fill();
    scratch.through.on.assign(1, {surface.primitive, surface.face, surface.was_entering});
    scratch.through.through = true;
    Nearest nearest(behind.count, reach);
    find_fan(behind, &scratch.through, mask, scratch, nearest);
    for (std::size_t i = 0; i < behind.count; ++i)
      if (nearest.found(i)) touches[own[i]] = true;
  }
}

/// Rays that go apart by many items have few boxes of a large hierarchy in common: each walks it
/// alone.
bool World::Impl::diverge(FanLines const& rays, std::uint8_t mask) const {
  constexpr double many = 7;
  constexpr std::size_t few = 8;
  Group const& asked = group(mask);
  if (asked.bvh.nodes().size() < few) return false;
  double const size = glm::length(asked.hull.high - asked.hull.low);
  return native.extents(rays).spread(size) > many * asked.grain;
}

void World::Impl::closest_fan(FanLines const& rays, std::uint32_t const* place,
                              Departure const* from, std::uint8_t mask, double const* t_max,
                              Scratch& scratch, Hits& hits) const {
  auto const until = [&](std::size_t k) { return t_max == nullptr ? everywhere : t_max[k]; };
  if (diverge(rays, mask)) {
    for (std::size_t k = 0; k < rays.count; ++k)
      find_alone(rays.get(k), from, mask, until(k), scratch, hits, place[k]);
    return;
  }
  Nearest nearest(rays.count, t_max);
  find_fan(rays, from, mask, scratch, nearest);
  FanVectors point, point_error;
  native.points(rays, nearest, point, point_error);
  for (std::size_t k = 0; k < rays.count; ++k) {
    std::uint32_t const to = place[k];
    hits.hit[to] = {};
    if (!nearest.found(k)) continue;
    FanProposal const& proposal = proposal_of(scratch, nearest.first, k);
    if (proposal.alone && nearest.single(k)) {
      hits.hit[to] = single_of(proposal, nearest.first, k);
      hits.t[to] = nearest.first.t[k];
      hits.error[to] = nearest.first.error[k];
      hits.point.set(to, point.get(k));
      hits.point_error.set(to, point_error.get(k));
      continue;
    }
    HitGroup& group = hits.groups.add();
    if (proposal.alone && nearest.pair(k) && proposal_of(scratch, nearest.second, k).alone)
      closest_pair(rays.get(k), pair_of(scratch, nearest, k), mask, until(k), scratch, group);
    else
      closest_group(rays.get(k), from, mask, until(k), scratch, group);
    hits.take_group(to);
  }
  if (!contacts.any()) return;
  bool touches[fan_width] = {};
  find_contacts(rays, place, mask, t_max, scratch, hits, touches);
  for (std::size_t k = 0; k < rays.count; ++k) {
    if (!touches[k]) continue;
    closest_group(rays.get(k), from, mask, until(k), scratch, hits.groups.add());
    hits.take_group(place[k]);
  }
}

void World::Impl::occluded_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                               double const* t_max, Scratch& scratch, bool* blocked,
                               bool* clear) const {
  if (diverge(rays, mask)) {
    for (std::size_t k = 0; k < rays.count; ++k) {
      blocked[k] = occluded(rays.get(k), from, mask, t_max[k], scratch);
      clear[k] = !blocked[k];
    }
    return;
  }
  Nearest nearest(rays.count, t_max, true);
  find_fan(rays, from, mask, scratch, nearest);
  for (std::size_t k = 0; k < rays.count; ++k) {
    clear[k] = !nearest.found(k);
    blocked[k] = nearest.blocked(k);
  }
}

} // namespace abbe::geometry
