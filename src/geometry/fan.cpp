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

void FanHits::copy(std::size_t to, FanHits const& from, std::size_t k) {
  hit[to] = from.hit[k];
  if (hit[to].kind == FanHit::Kind::Pair) pair[to] = from.pair[k];
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

namespace {

/// set_point() for all rays; without meaning for those that met nothing.
struct FindPoints {
  template <class L>
  static void run(FanLines const& rays, FanNearest const& nearest, FanHits& out) {
    lane::in_lanes<L>(rays.count, [&]<class Lanes>(std::size_t at) {
      auto const t = lane::load<Lanes>(nearest.first.t + at),
                 error = lane::load<Lanes>(nearest.first.error + at);
      lane::store(out.t + at, t);
      lane::store(out.error + at, error);
      auto const along = [&](double const* origin, double const* direction, double* point,
                             double* point_error) {
        auto const d = lane::load<Lanes>(direction + at), step = t * d;
        auto const p = lane::load<Lanes>(origin + at) + step;
        lane::store(point + at, p);
        lane::store(point_error + at,
                    lane::abs(d) * error
                        + Lanes(gamma_bound(2)) * (lane::abs(step) + lane::abs(p)));
      };
      along(rays.origin.x, rays.direction.x, out.point.x, out.point_error.x);
      along(rays.origin.y, rays.direction.y, out.point.y, out.point_error.y);
      along(rays.origin.z, rays.direction.z, out.point.z, out.point_error.z);
    });
  }
};

SurfaceCrossing crossing_of(FanProposal const& proposal, FanNearest::Crossing const& found,
                            std::size_t k) {
  bool const entering = (found.entering[k] != 0) != proposal.inverse;
  return {proposal.solid, proposal.primitive, static_cast<std::uint32_t>(found.face[k]),
          found.t[k],     entering,           proposal.toggles};
}

/// What is known of the surfaces.
void write_hits(std::size_t count, FanNearest const& nearest,
                std::vector<FanProposal> const& proposals, FanHits& out) {
  auto const proposal_of = [&](FanNearest::Crossing const& found, std::size_t k) -> auto const& {
    return proposals[static_cast<std::size_t>(found.proposal[k])];
  };
  for (std::size_t k = 0; k < count; ++k) {
    FanHit& hit = out.hit[k];
    hit = {};
    if (!nearest.found(k)) continue;
    FanProposal const& proposal = proposal_of(nearest.first, k);
    hit.kind = FanHit::Kind::Unclear;
    if (!proposal.alone) continue;
    if (nearest.single(k)) {
      hit.kind = FanHit::Kind::Single;
      hit.was_entering = nearest.first.entering[k] != 0;
      hit.entering = hit.was_entering != proposal.inverse;
      hit.toggles = proposal.toggles;
      hit.solid = proposal.solid;
      hit.primitive = proposal.primitive;
      hit.face = static_cast<std::uint32_t>(nearest.first.face[k]);
    } else if (nearest.pair(k) && proposal_of(nearest.second, k).alone) {
      hit.kind = FanHit::Kind::Pair;
      FanPair& pair = out.pair[k];
      FanNearest::Crossing const* const found[] = {&nearest.first, &nearest.second};
      for (std::size_t i = 0; i < 2; ++i) {
        pair.crossing[i] = crossing_of(proposal_of(*found[i], k), *found[i], k);
        pair.error[i] = found[i]->error[k];
        pair.was_entering[i] = found[i]->entering[k] != 0;
      }
    }
  }
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
    return true;
  });
}

/// What leaves a solid with partners is clear when there is nothing as near behind it as they
/// reach.
void World::Impl::find_contacts(FanLines const& rays, std::uint8_t mask, double const* t_max,
                                Scratch& scratch, FanHits& hits) const {
  bool open[fan_width];
  for (std::size_t k = 0; k < rays.count; ++k) {
    FanHit const& hit = hits.hit[k];
    bool const leaves = hit.kind == FanHit::Kind::Single && !hit.entering && hit.toggles;
    open[k] = leaves && contacts.reach(hit.solid) > 0;
  }
  for (std::size_t first = 0; first < rays.count; ++first) {
    if (!open[first]) continue;
    FanHit const surface = hits.hit[first];
    double const widest = contacts.reach(surface.solid);
    FanLines behind;
    double reach[fan_width];
    std::size_t place[fan_width];
    behind.count = 0;
    for (std::size_t k = first; k < rays.count; ++k) {
      if (!open[k] || !(hits.hit[k] == surface)) continue;
      open[k] = false;
      Vec3 const point = hits.point.get(k), direction = rays.direction.get(k);
      Vec3 const normal = primitives[surface.primitive].normal(surface.face, point, true);
      double const room = t_max == nullptr ? everywhere : t_max[k] - hits.t[k];
      reach[behind.count] = std::min(widest / std::fabs(glm::dot(direction, normal)), room);
      place[behind.count] = k;
      behind.origin.set(behind.count, point);
      behind.direction.set(behind.count, direction);
      behind.origin_error.set(behind.count, hits.point_error.get(k));
      ++behind.count;
    }
    behind.fill();
    scratch.through.on.assign(1, {surface.primitive, surface.face, surface.was_entering});
    scratch.through.through = true;
    Nearest nearest(behind.count, reach);
    find_fan(behind, &scratch.through, mask, scratch, nearest);
    for (std::size_t i = 0; i < behind.count; ++i)
      if (nearest.found(i)) hits.hit[place[i]].kind = FanHit::Kind::Unclear;
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

void World::Impl::find_each(FanLines const& rays, Departure const* from, std::uint8_t mask,
                            double const* t_max, Scratch& scratch, FanHits& hits) const {
  for (std::size_t k = 0; k < rays.count; ++k) {
    FanHit& hit = hits.hit[k];
    hit = {};
    Alone alone;
    Kind const kind = first_single(rays.get(k), from, mask,
                                   t_max == nullptr ? everywhere : t_max[k], scratch, alone);
    if (kind != Kind::Single) {
      hit.kind = kind == Kind::Nothing ? FanHit::Kind::Nothing : FanHit::Kind::Unclear;
      continue;
    }
    SurfaceCrossing const& crossing = alone.crossing;
    hit = {FanHit::Kind::Single, crossing.entering,  crossing.toggles, alone.was_entering,
           crossing.solid,       crossing.primitive, crossing.face};
    hits.t[k] = crossing.t;
    hits.error[k] = alone.error;
    Vec3 point, point_error;
    set_point(rays.origin.get(k), rays.direction.get(k), crossing.t, alone.error, point,
              point_error);
    hits.point.set(k, point);
    hits.point_error.set(k, point_error);
  }
}

void World::closest_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                        double const* t_max, Scratch& scratch, FanHits& hits) const {
  if (impl_->diverge(rays, mask)) {
    impl_->find_each(rays, from, mask, t_max, scratch, hits);
    if (impl_->contacts.any()) impl_->find_contacts(rays, mask, t_max, scratch, hits);
    return;
  }
  Impl::Nearest nearest(rays.count, t_max);
  impl_->find_fan(rays, from, mask, scratch, nearest);
  native.points(rays, nearest, hits);
  write_hits(rays.count, nearest, scratch.proposals, hits);
  if (impl_->contacts.any()) impl_->find_contacts(rays, mask, t_max, scratch, hits);
}

void World::occluded_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                         double const* t_max, Scratch& scratch, bool* blocked, bool* clear) const {
  if (impl_->diverge(rays, mask)) {
    for (std::size_t k = 0; k < rays.count; ++k) {
      blocked[k] = occluded(rays.get(k), from, mask, t_max[k], scratch);
      clear[k] = !blocked[k];
    }
    return;
  }
  Impl::Nearest nearest(rays.count, t_max);
  impl_->find_fan(rays, from, mask, scratch, nearest);
  for (std::size_t k = 0; k < rays.count; ++k) {
    clear[k] = !nearest.found(k);
    blocked[k] = !clear[k] && nearest.end[k] < t_max[k];
  }
}

bool World::flat(PrimitiveId id, std::uint32_t face) const {
  return impl_->primitives[id].shape().flat(face);
}

} // namespace abbe::geometry
