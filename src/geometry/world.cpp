// SPDX-License-Identifier: MIT
#include "geometry/fan_solids.hpp"
#include "geometry/world_impl.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

void ScratchDeleter::operator()(Scratch* scratch) const {
  delete scratch;
}
ScratchPtr World::make_scratch() {
  return ScratchPtr(new Scratch);
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

namespace {

/// Candidates within the error of the nearest become the group.
void settle(Ray const& ray, Scratch& scratch, std::size_t nearest, HitGroup& out) {
  auto& candidates = scratch.candidates;
  double const t = candidates[nearest].crossing.t;
  double const end = t + candidates[nearest].error;
  SolidId const first_solid = candidates[nearest].crossing.solid;
  auto const near = [&](Candidate const& c) { return c.crossing.t - c.error <= end; };
  bool const several =
      candidates.size() > 1
      && std::any_of(candidates.begin(), candidates.end(), [&](Candidate const& c) {
           return c.crossing.solid != first_solid && near(c);
         });
  if (!several) {
    // A solid's own events are distinct, however close.
    if (nearest > 0) candidates[0] = candidates[nearest];
    candidates.resize(1);
  } else {
    std::erase_if(candidates, [&](Candidate const& c) { return !near(c); });
    std::sort(candidates.begin(), candidates.end(), [](Candidate const& a, Candidate const& b) {
      return a.crossing.solid != b.crossing.solid ? a.crossing.solid < b.crossing.solid
                                                  : a.crossing.t < b.crossing.t;
    });
  }
  out.clear();
  out.t = t;
  out.error = 0;
  for (Candidate const& c : candidates) {
    out.error = std::max(out.error, std::fabs(c.crossing.t - t) + c.error);
    out.crossings.push_back(c.crossing);
    auto const first = scratch.members.begin() + c.first_member;
    out.members.insert(out.members.end(), first, first + c.members);
  }
  set_point(ray.origin, ray.direction, t, out.error, out.point, out.point_error);
}

} // namespace

bool World::Impl::first_group(Ray const& ray, Departure const* from, std::uint8_t mask,
                              double t_max, Scratch& scratch, HitGroup& out) const {
  prepare(scratch);
  scratch.candidates.clear();
  scratch.members.clear();
  double best = everywhere, best_end = t_max;
  double begin = everywhere; // of the first candidate's error interval
  std::size_t nearest = 0;
  each_solid<NodeProbe>(ray, mask, 0.0, best_end, [&](SolidId id) {
    TracedSolid const& solid = solids[id];
    if ((solid.mask() & mask) == 0) return true;
    solid.passages(
        query(id, ray, from, scratch, best_end), false, [&](TracedSolid::Passage const& passage) {
          SurfaceCrossing const& crossing = passage.crossing;
          if (!(crossing.t < t_max) || crossing.t - passage.error > best_end) return false;
          if (!passage.visible) return true;
          if (crossing.t < best) {
            best = crossing.t;
            best_end = crossing.t + passage.error;
            // Clear of all before it: they are out of the question.
            if (best_end < begin) {
              scratch.candidates.clear();
              scratch.members.clear();
              begin = everywhere;
            }
            nearest = scratch.candidates.size();
          }
          begin = std::min(begin, crossing.t - passage.error);
          auto const first = static_cast<std::uint32_t>(scratch.members.size());
          for (std::size_t i = passage.first; i < passage.last; ++i) {
            Event const& event = scratch.events[i];
            scratch.members.push_back({event.primitive, event.face, event.entering});
          }
          scratch.candidates.push_back({crossing, passage.error, first,
                                        static_cast<std::uint32_t>(passage.last - passage.first)});
          return true;
        });
    return true;
  });
  if (scratch.candidates.empty()) return false;
  settle(ray, scratch, nearest, out);
  return true;
}

void World::Impl::closest_pair(Ray const& ray, Pair const& pair, std::uint8_t mask, double t_max,
                               Scratch& scratch, HitGroup& out) const {
  prepare(scratch);
  scratch.candidates.clear();
  scratch.members.clear();
  for (std::uint32_t i = 0; i < 2; ++i) {
    SurfaceCrossing const& crossing = pair.crossing[i];
    scratch.candidates.push_back({crossing, pair.error[i], i, 1});
    scratch.members.push_back({crossing.primitive, crossing.face, pair.was_entering[i]});
  }
  settle(ray, scratch, 0, out);
  if (contacts.any()) join_contact(ray, mask, t_max, scratch, out);
}

/// The rule of Contacts: the gap is measured across, whatever the ray's obliquity, and must be
/// empty.
void World::Impl::join_contact(Ray const& ray, std::uint8_t mask, double t_max, Scratch& scratch,
                               HitGroup& out) const {
  SurfaceCrossing const* left = nullptr;
  double widest = 0;
  for (SurfaceCrossing const& crossing : out.crossings) {
    if (crossing.entering || !crossing.toggles) return;
    double const reach = contacts.reach(crossing.solid);
    if (reach > widest) {
      widest = reach;
      left = &crossing;
    }
  }
  if (left == nullptr) return;
  SolidId const leaves = left->solid;
  Vec3 const normal = primitives[left->primitive].normal(left->face, out.point, true);
  double const steep = std::fabs(glm::dot(ray.direction, normal));
  HitGroup& beyond = scratch.beyond;
  scratch.through.on = out.members;
  scratch.through.through = true;
  if (!first_group({out.point, ray.direction, out.point_error}, &scratch.through, mask,
                   std::min(widest / steep, t_max - out.t), scratch, beyond)) {
    return;
  }
  double gap = everywhere;
  for (SurfaceCrossing const& crossing : beyond.crossings) {
    if (!crossing.entering || !crossing.toggles) continue;
    Vec3 const facing = primitives[crossing.primitive].normal(crossing.face, beyond.point, true);
    double const across = beyond.t * std::max(steep, std::fabs(glm::dot(ray.direction, facing)));
    if (across <= contacts.reach(leaves, crossing.solid)) gap = std::min(gap, across);
  }
  if (!(gap < everywhere)) return;
  for (SurfaceCrossing crossing : beyond.crossings) {
    crossing.t = out.t;
    out.crossings.push_back(crossing);
  }
  std::stable_sort(
      out.crossings.begin(), out.crossings.end(),
      [](SurfaceCrossing const& a, SurfaceCrossing const& b) { return a.solid < b.solid; });
  out.members.insert(out.members.end(), beyond.members.begin(), beyond.members.end());
  // So far is the point from the surface beyond.
  out.point_error += gap * glm::abs(normal);
}

void World::containing(Vec3 const& point, Scratch& scratch, std::vector<SolidId>& out) const {
  impl_->prepare(scratch);
  out.clear();
  scratch.entered.clear();
  // Along no axis, diagonal or edge that a scene is likely to have.
  Ray const ray{point, Vec3(0.3713906763541037, 0.5570860145311556, 0.7427813527082074), Vec3(0)};
  double const here = 0.0;
  impl_->each_solid<NodeProbe>(ray, 0xff, 0.0, here, [&](SolidId id) {
    double entry = -everywhere;
    bool any = false, inside = false;
    bool const before = impl_->solids[id].passages(impl_->query(id, ray, nullptr, scratch), true,
                                                   [&](TracedSolid::Passage const& passage) {
                                                     if (passage.crossing.t > 0) return false;
                                                     if (!passage.crossing.toggles) return true;
                                                     any = true;
                                                     inside = passage.inside;
                                                     entry = passage.crossing.t;
                                                     return true;
                                                   });
    if (any ? inside : before) scratch.entered.push_back({entry, id});
    return true;
  });
  std::sort(scratch.entered.begin(), scratch.entered.end(),
            [](Scratch::Entered const& a, Scratch::Entered const& b) {
              return a.t != b.t ? a.t < b.t : a.solid < b.solid;
            });
  for (Scratch::Entered const& entered : scratch.entered) out.push_back(entered.solid);
}

Vec3 World::normal(PrimitiveId id, std::uint32_t face, Vec3 const& point) const {
  return impl_->primitives[id].normal(face, point, false);
}
Vec3 World::geometric_normal(PrimitiveId id, std::uint32_t face, Vec3 const& point) const {
  return impl_->primitives[id].normal(face, point, true);
}
World::Normals World::normals(PrimitiveId id, std::uint32_t face, Vec3 const& point) const {
  Placed const& placed = impl_->primitives[id];
  Vec3 const smoothed = placed.normal(face, point, false);
  return {smoothed, placed.shape().smoothed() ? placed.normal(face, point, true) : smoothed};
}
Vec3 World::facing(PrimitiveId id, std::uint32_t face, Vec3 const& point) const {
  return impl_->primitives[id].facing(face, point);
}
bool World::inside(PrimitiveId id, Vec3 const& point) const {
  Placed const& placed = impl_->primitives[id];
  return placed.shape().inside(placed.to_object(point));
}
Bounds World::bounds(SolidId id) const {
  return impl_->bounds(id);
}
void World::meeting(Vec3 const& low, Vec3 const& high, std::vector<SolidId>& out) const {
  Impl::Group const& all = impl_->all;
  out.insert(out.end(), all.infinite.begin(), all.infinite.end());
  each_meeting(all.bvh, all.bvh.space().box(low, high, 0),
               [&](std::uint32_t solid) { out.push_back(solid); });
}
std::optional<PrimitiveId> World::lone(SolidId id) const {
  TracedSolid const& solid = impl_->solids[id];
  if (solid.has_program()) return std::nullopt;
  return solid.only();
}
std::optional<FaceBlend> World::face_blend(PrimitiveId id, std::uint32_t face,
                                           Vec3 const& point) const {
  Placed const& placed = impl_->primitives[id];
  return placed.shape().face_blend(placed.to_object(point), face);
}
Vec2 World::uv(PrimitiveId id, std::uint32_t face, Vec3 const& point) const {
  Placed const& placed = impl_->primitives[id];
  Vec3 const inner = placed.to_object(point);
  return placed.shape().uv(inner, face).value_or(Vec2(inner.x, inner.y));
}
Shape const& World::shape(PrimitiveId id) const {
  return impl_->primitives[id].shape();
}

} // namespace abbe::geometry
