// SPDX-License-Identifier: MIT
#include "lang/object_query.hpp"

#include "scene/object_tree.hpp"

#include <limits>

namespace abbe::lang {
ObjectQuery ObjectQuery::of(scene::Object const& object) {
  auto world = scene::world_of(object);
  bool const nothing = !world;
  return ObjectQuery(world ? std::move(*world) : geometry::World({}, {}), nothing);
}

std::optional<ObjectQuery::Hit> ObjectQuery::trace(Vec3 const& start, Vec3 const& direction) const {
  auto const scratch = geometry::World::make_scratch();
  geometry::HitGroup hit;
  geometry::Ray const ray{start, glm::normalize(direction), Vec3(0)};
  if (!world_.closest(ray, nullptr, 0xff, std::numeric_limits<double>::infinity(), *scratch, hit)
      || hit.crossings.empty())
    return std::nullopt;
  auto const& crossing = hit.crossings.front();
  Vec3 normal = world_.normal(crossing.primitive, crossing.face, hit.point);
  bool const against = glm::dot(normal, ray.direction) < 0;
  if (against != crossing.entering) normal = -normal;
  return Hit{hit.point, normal};
}

bool ObjectQuery::inside(Vec3 const& point) const {
  auto const scratch = geometry::World::make_scratch();
  std::vector<geometry::SolidId> solids;
  world_.containing(point, *scratch, solids);
  return !solids.empty();
}

geometry::Bounds ObjectQuery::bounds() const {
  constexpr double far = 1e10;
  geometry::Bounds bounds = world_.bounds(0);
  if (bounds.infinite) bounds = {Vec3(-far), Vec3(far), true};
  return bounds;
}

} // namespace abbe::lang
