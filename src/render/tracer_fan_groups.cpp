// SPDX-License-Identifier: MIT
#include "render/tracer.hpp"

#include <algorithm>

/// Hits of several surfaces at once (a filling against its vessel), in fans: rays that meet the
/// same ones go on together.
namespace abbe::render {
namespace {

/// Do they differ in place only?
bool same_surfaces(geometry::HitGroup const& a, geometry::HitGroup const& b) {
  auto const same_crossing = [](auto const& x, auto const& y) {
    return x.solid == y.solid && x.primitive == y.primitive && x.face == y.face
           && x.entering == y.entering && x.toggles == y.toggles;
  };
  auto const same_member = [](auto const& x, auto const& y) {
    return x.primitive == y.primitive && x.face == y.face && x.was_entering == y.was_entering;
  };
  return std::equal(a.crossings.begin(), a.crossings.end(), b.crossings.begin(), b.crossings.end(),
                    same_crossing)
         && std::equal(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(),
                       same_member);
}

} // namespace

bool Tracer::find_groups(FanRay const& fan, double const* t_max, geometry::FanHits& hits,
                         Frame& here, FanGroups& groups) {
  using Kind = geometry::FanHit::Kind;
  auto const is_several = [](geometry::FanHit const& hit) {
    return hit.kind == Kind::Pair || hit.kind == Kind::Unclear;
  };
  if (std::none_of(hits.hit, hits.hit + fan.lines->count, is_several)) return false;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::size_t number = 0;
  for (std::size_t k = 0; k < fan.lines->count; ++k) {
    groups[k] = nullptr;
    geometry::FanHit& hit = hits.hit[k];
    if (!is_several(hit)) continue;
    if (here.groups.size() == number) here.groups.emplace_back();
    geometry::HitGroup& group = here.groups[number++];
    double const until = t_max == nullptr ? infinity : t_max[k];
    geometry::Ray const ray = fan.lines->get(k);
    if (hit.kind == Kind::Pair) {
      stage_.world->closest_pair(ray, hits.pair[k], fan.mask, until, *scratch_, group);
    } else if (!stage_.world->closest_group(ray, fan.from, fan.mask, until, *scratch_, group)) {
      hit.kind = Kind::Nothing;
      continue;
    }
    groups[k] = &group;
    geometry::SurfaceCrossing const& shown = group.crossings[carrier_of(group.crossings)];
    hit = {Kind::Single, shown.entering,  shown.toggles, shown.entering,
           shown.solid,  shown.primitive, shown.face};
    hits.t[k] = group.t;
    hits.error[k] = group.error;
    hits.point.set(k, group.point);
    hits.point_error.set(k, group.point_error);
  }
  return true;
}

bool Tracer::same_group(geometry::HitGroup const* a, geometry::HitGroup const* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return same_surfaces(*a, *b);
}

} // namespace abbe::render
