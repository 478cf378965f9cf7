// SPDX-License-Identifier: MIT
#include "scene/object_tree.hpp"

#include <utility>

namespace abbe::scene {
namespace {

using geometry::CsgTree;
using geometry::Transform;

/// Collects the shapes of an object and how they are combined.
class Collector {
public:
  std::vector<geometry::PlacedShape> primitives;

  /// @param outer the object's parent's space -> the space of the world
  CsgTree tree(Object const& object, Transform const& outer) {
    Transform const placed = object.placement.then(outer);
    CsgTree out;
    if (object.kind == Object::Kind::Shape) {
      out.primitive = static_cast<geometry::PrimitiveId>(primitives.size());
      primitives.push_back({object.shape, placed});
    } else {
      // A merge of no children is nothing, as an operand too.
      out.op = object.children.empty()                     ? CsgTree::Op::Merge
               : object.kind == Object::Kind::Intersection ? CsgTree::Op::Intersection
               : object.kind == Object::Kind::Difference   ? CsgTree::Op::Difference
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

std::optional<geometry::World> world_of(Object const& object, Transform const& outer) {
  Collector collector;
  auto tree = collector.tree(object, outer);
  if (collector.primitives.empty()) return std::nullopt;
  std::vector<geometry::World::Solid> solids;
  solids.push_back({std::move(tree), 0xff});
  return geometry::World(std::move(collector.primitives), std::move(solids));
}

} // namespace abbe::scene
