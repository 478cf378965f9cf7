// SPDX-License-Identifier: MIT
#include "transport/caustics/forced.hpp"

#include "transport/caustics/light_paths.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {

void ForcedPaths::cross(Step const& step, std::size_t at, Chain const& chain, ForcedRays& rays) {
  Chunk& c = chunk_;
  Step const* const last = at > 0 ? &chain.steps[at - 1] : nullptr;
  bool const again = last != nullptr && last->primitive == step.primitive;
  std::size_t const count = rays.count;
  if (step.flat) {
    for (std::size_t r = 0; r < count; ++r) {
      double const t = glm::dot(step.point - rays.origin.get(r), step.normal)
                       / glm::dot(rays.direction.get(r), step.normal);
      way_[r] = std::isfinite(t) ? t : 0;
      faces_[r] = step.face;
    }
  } else {
    bool const starts = again && !last->flat;
    if (starts)
      for (std::size_t r = 0; r < count; ++r)
        starts_[r] = {faces_[r], last->entering != last->mirror};
    for (std::size_t r = count; r % 8 != 0; ++r) {
      rays.origin.set(r, rays.origin.get(count - 1));
      rays.direction.set(r, rays.direction.get(count - 1));
    }
    stage_.world->crossings_of(step.primitive, count, rays.origin.arrays(), rays.direction.arrays(),
                               starts ? starts_ : nullptr, step.entering, *scratch_, way_.value,
                               faces_);
  }
  std::size_t good = chunk_width;
  for (std::size_t r = 0; r < count; ++r) {
    if ((rays.valid >> r & 1) == 0) continue;
    double const t = way_[r];
    if (!(t > 0)) {
      rays.valid &= ~(RaySet{1} << r);
      continue;
    }
    c.direction.set(r, rays.direction.get(r));
    c.point.set(r, rays.origin.get(r) + t * rays.direction.get(r));
    rays.length[r] += t;
    for (std::size_t m = 0; m < std::min(chain.absorbing.size(), most_absorbing); ++m)
      if (step.before == chain.absorbing[m]) rays.inside[m][r] += t;
    good = std::min(good, r);
  }
  if (rays.valid == 0) return;
  // The others go along with one that is met.
  for (std::size_t r = 0; r < rays.count; ++r) {
    bool const met = (rays.valid >> r & 1) != 0;
    if (!met) {
      c.point.set(r, c.point.get(good));
      c.direction.set(r, c.direction.get(good));
      faces_[r] = faces_[good];
    }
    c.hit[r] = {};
    c.hit[r].kind = geometry::RayHit::Kind::Single;
    c.hit[r].primitive = step.primitive;
    c.hit[r].face = faces_[r];
    c.hit[r].entering = c.hit[r].was_entering = step.entering;
    c.n1[r] = waves_.index(rays.wave[r], step.before);
    c.n2[r] = waves_.index(rays.wave[r], step.after);
  }
}

void ForcedPaths::follow(Chain const& chain, ForcedRays& rays) {
  Chunk& c = chunk_;
  c.group = nullptr;
  c.each = 0;
  c.count = rays.count;
  rays.valid = first_rays(rays.count);
  for (std::size_t r = 0; r < rays.count; ++r) {
    rays.length[r] = 0;
    rays.share[r] = 1;
    for (Values& inside : rays.inside) inside[r] = 0;
  }
  for (std::size_t at = 0; at < chain.steps.size(); ++at) {
    Step const& step = chain.steps[at];
    rays_ += rays.count;
    cross(step, at, chain, rays);
    if (rays.valid == 0) return;
    Arena::Scope const scope(arena_);
    bend(stage_, arena_, c);
    if (rays.points != nullptr)
      for (std::size_t r = 0; r < rays.count; ++r) rays.points->push_back(c.point.get(r));
    if (!step.mirror && step.bends) rays.valid &= ~c.total;
    bool const fresnel = stage_.medium(step.before).fresnel || stage_.medium(step.after).fresnel;
    each_of(rays.valid, [&](std::size_t r) {
      if (fresnel) rays.share[r] *= step.mirror ? c.reflectance[r] : c.transmittance[r];
      rays.origin.set(r, c.point.get(r));
      if (step.mirror)
        rays.direction.set(r, c.mirrored.get(r));
      else if (step.bends && c.n1[r] != c.n2[r])
        rays.direction.set(r, c.refracted.get(r));
    });
  }
}

bool ForcedPaths::follow_nodes(Chain const& chain, Emission const& emission, Cell const& cell,
                               int wave, ForcedRays& rays) {
  rays.count = 9;
  for (std::size_t k = 0; k < rays.count; ++k) {
    Emission::Place const place{cell.face,
                                cell.low() + 0.5 * cell.size() * node_place(static_cast<int>(k))};
    rays.origin.set(k, emission.origin(place));
    rays.direction.set(k, emission.direction(place));
    rays.wave[k] = wave;
  }
  follow(chain, rays);
  return rays.valid == first_rays(rays.count);
}

} // namespace abbe::transport::caustics
