// SPDX-License-Identifier: MIT
#include "lang/object_query.hpp"

#include <limits>

namespace abbe::lang {
namespace {

using geometry::CsgTree;
using geometry::Transform;

/// Collects the shapes of an object and how they are combined.
class Collector {
public:
  std::vector<geometry::PlacedShape> primitives;

  /// @param outer the object's parent's space -> the space of the question
  CsgTree tree(scene::Object const& object, Transform const& outer) {
    Transform const placed = object.placement.then(outer);
    CsgTree out;
    if (object.kind == scene::Object::Kind::Shape) {
      out.primitive = static_cast<geometry::PrimitiveId>(primitives.size());
      primitives.push_back({object.shape, placed});
    } else {
      // A merge of no children is nothing, as an operand too.
      out.op = object.children.empty()                            ? CsgTree::Op::Merge
               : object.kind == scene::Object::Kind::Intersection ? CsgTree::Op::Intersection
               : object.kind == scene::Object::Kind::Difference   ? CsgTree::Op::Difference
                                                                  : CsgTree::Op::Merge;
      for (auto const& child : object.children) out.children.push_back(tree(child, placed));
    }
    out.inverse = object.inverse;
    if (object.clipped_by.empty()) return out;
    CsgTree clipped;
    clipped.op = CsgTree::Op::Clip;
    clipped.children.push_back(std::move(out));
    for (auto const& by : object.clipped_by) clipped.children.push_back(tree(by, outer));
    return clipped;
  }
};

} // namespace

ObjectQuery ObjectQuery::of(scene::Object const& object) {
  Collector collector;
  auto tree = collector.tree(object, {});
  std::vector<geometry::World::Solid> solids;
  bool const nothing = collector.primitives.empty();
  if (!nothing) solids.push_back({std::move(tree), 0xff});
  return ObjectQuery(geometry::World(std::move(collector.primitives), std::move(solids)), nothing);
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
