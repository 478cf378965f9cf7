// SPDX-License-Identifier: MIT
#include "geometry/traced_solid.hpp"

#include "geometry/half_space_bounds.hpp"
#include "geometry/half_spaces.hpp"
#include "geometry/quadric_bounds.hpp"
#include "geometry/shapes/convex.hpp"
#include "geometry/shapes/quadric.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace abbe::geometry {

namespace {

/// Operands from which on a hierarchy pays.
constexpr std::size_t many_operands = 8;
/// Events up to which looking through them costs less than changing states to and fro.
constexpr std::size_t few_events = 16;

} // namespace

namespace {

/// TracedSolid::tree_->traits
constexpr std::uint8_t carrier = 1, unbounded = 2;

/// Bounded operands outside of all of which the tree is false: few, or none known.
std::optional<std::vector<std::uint32_t>> carriers_of(CsgTree const& tree,
                                                      std::vector<PrimitiveId> const& operands,
                                                      std::vector<Placed> const& primitives) {
  if (tree.inverse) return std::nullopt;
  if (tree.op == CsgTree::Op::Primitive) {
    if (primitives[tree.primitive].bounds().infinite) return std::nullopt;
    auto const at = std::lower_bound(operands.begin(), operands.end(), tree.primitive);
    return std::vector{static_cast<std::uint32_t>(at - operands.begin())};
  }
  if (tree.children.empty()) return std::nullopt;
  if (tree.op == CsgTree::Op::Difference) {
    return carriers_of(tree.children.front(), operands, primitives);
  }
  bool const any = tree.op == CsgTree::Op::Merge;
  std::optional<std::vector<std::uint32_t>> result;
  for (CsgTree const& child : tree.children) {
    auto const of_child = carriers_of(child, operands, primitives);
    if (any && !of_child) return std::nullopt;
    if (!of_child) continue;
    if (!result) {
      result = of_child;
    } else if (any) {
      result->insert(result->end(), of_child->begin(), of_child->end());
    } else if (of_child->size() < result->size()) {
      result = of_child;
    }
    if (any && result->size() > many_operands) return std::nullopt;
  }
  if (result) {
    std::sort(result->begin(), result->end());
    result->erase(std::unique(result->begin(), result->end()), result->end());
  }
  return result;
}

bool merges_primitives(CsgTree const& tree) {
  if (tree.inverse) return false;
  if (tree.op == CsgTree::Op::Primitive) return true;
  return tree.op == CsgTree::Op::Merge
         && std::all_of(tree.children.begin(), tree.children.end(), merges_primitives);
}

} // namespace

namespace {

/// Half-spaces and quadrics that hold all of the inside of a tree.
void half_spaces_of(CsgTree const& tree, std::vector<Placed> const& primitives,
                    std::vector<HalfSpace>& out, std::vector<WorldQuadric>& quadrics) {
  if (tree.op == CsgTree::Op::Primitive) {
    Placed const& placed = primitives[tree.primitive];
    auto const* const quadric = dynamic_cast<Quadric const*>(&placed.shape());
    if (quadric != nullptr && !tree.inverse)
      quadrics.push_back(WorldQuadric::of(placed, quadric->coefficients()));
    std::size_t const first = out.size();
    if (!tree.inverse || is_plane(placed.shape())) placed.half_spaces(out);
    for (std::size_t i = first; tree.inverse && i < out.size(); ++i)
      out[i] = {-out[i].normal, -out[i].most};
    return;
  }
  if (tree.inverse || tree.op == CsgTree::Op::Merge) return;
  for (CsgTree const& child : tree.children) {
    half_spaces_of(child, primitives, out, quadrics);
    if (tree.op == CsgTree::Op::Difference) return;
  }
}

} // namespace

Bounds bounds_of(CsgTree const& tree, std::vector<Placed> const& primitives) {
  if (tree.inverse) return all_space();
  if (tree.op == CsgTree::Op::Primitive) return primitives[tree.primitive].bounds();
  Bounds result;
  bool first = true;
  for (CsgTree const& child : tree.children) {
    bool const outside_counts = tree.op == CsgTree::Op::Difference && !first;
    if (outside_counts) break;
    Bounds const bounds = bounds_of(child, primitives);
    if (first) {
      result = bounds;
    } else {
      result = tree.op == CsgTree::Op::Merge ? hull(result, bounds) : overlap(result, bounds);
    }
    first = false;
  }
  if (!result.infinite || tree.op == CsgTree::Op::Merge) return result;
  std::vector<HalfSpace> spaces;
  std::vector<WorldQuadric> quadrics;
  half_spaces_of(tree, primitives, spaces, quadrics);
  Bounds const by_planes = bounds_of(spaces);
  return by_planes.infinite ? bounds_of(spaces, quadrics) : by_planes;
}

TracedSolid::TracedSolid(World::Solid const& source, std::vector<Placed> const& primitives,
                         SolidId id)
    : id_(id), mask_(source.mask) {
  if (source.tree.op == CsgTree::Op::Primitive) {
    only_ = source.tree.primitive;
    inverse_ = source.tree.inverse;
    Shape const& shape = primitives[only_].shape();
    convex_ = shape.one_interval();
    EndsKernel const* const ends = shape.ends_kernel();
    ends_ = ends != nullptr && ends->ends_visible() ? ends : shape.surface_kernel();
  } else {
    tree_ = make_tree(source.tree, primitives);
  }
  if (ends_ == nullptr || inverse_)
    bounds_ = std::make_unique<Bounds const>(bounds_of(source.tree, primitives));
}

std::unique_ptr<TracedSolid::Tree const>
TracedSolid::make_tree(CsgTree const& source, std::vector<Placed> const& primitives) {
  auto tree = std::make_unique<Tree>(source);
  tree->cut = ConvexCut::of(source, tree->program, primitives);
  if (tree->cut && tree->cut->has_kernels()) {
    tree->fan_cut = tree->cut.get();
  } else {
    tree->lanes = LaneTree::of(source, tree->program, primitives);
  }
  auto const& operands = tree->program.operands();
  bool const many = operands.size() > many_operands;
  tree->traits.assign(operands.size(), 0);
  if (auto carriers = carriers_of(source, operands, primitives)) {
    tree->carriers = std::move(*carriers);
    for (std::uint32_t const operand : tree->carriers) tree->traits[operand] |= carrier;
  }
  BvhSpaceFinder finder;
  std::vector<std::uint32_t> finite;
  for (std::uint32_t i = 0; i < operands.size(); ++i) {
    Bounds const bounds = primitives[operands[i]].bounds();
    if (bounds.infinite && primitives[operands[i]].shape().solid()) {
      tree->traits[i] |= unbounded;
      tree->unbounded.push_back(i);
    }
    if (!many || bounds.infinite) {
      if ((tree->traits[i] & carrier) == 0) tree->always.push_back(i);
    } else if (!bounds.empty()) {
      finder.add(bounds.low, bounds.high);
      finite.push_back(i);
    }
  }
  BvhSpace const space = finder.space();
  std::vector<BvhBox> boxes;
  boxes.reserve(finite.size());
  for (std::uint32_t const i : finite) {
    Bounds const bounds = primitives[operands[i]].bounds();
    boxes.push_back(space.box(bounds.low, bounds.high, i));
  }
  tree->operand_bvh = Bvh(space, std::move(boxes));
  tree->merge = many && tree->always.empty() && merges_primitives(source);
  return tree;
}

void TracedSolid::gather_operand(Query const& query, std::uint32_t operand, bool all) const {
  PrimitiveId const primitive = tree_->program.operands()[operand];
  std::size_t const before = query.scratch.events.size();
  if (all) {
    gather(query, primitive, operand, tree_->program.hidden(operand));
  } else {
    gather_near(query, primitive, operand, tree_->program.hidden(operand));
  }
  if ((tree_->traits[operand] & unbounded) == 0) return;
  for (std::size_t i = before; i < query.scratch.events.size(); ++i) {
    if (query.scratch.events[i].toggles) return;
  }
  // The line is inside or outside all along; a bounded shape is not inside a whole line.
  Placed const& placed = query.primitives[primitive];
  tree_->program.set(*query.state, operand,
                     placed.shape().inside(placed.to_object(query.ray.origin)));
}

bool TracedSolid::gather_operands(Query const& query, bool all) const {
  if (!tree_->carriers.empty()) {
    for (std::uint32_t const operand : tree_->carriers) gather_operand(query, operand, all);
    if (!all && query.scratch.events.empty()) return false;
  }
  for (std::uint32_t const operand : tree_->always) gather_operand(query, operand, all);
  if (tree_->operand_bvh.nodes().empty()) return true;
  // Behind the start, an operand's crossings leave it outside: as if there were none.
  double const to = all ? everywhere : query.until;
  walk(tree_->operand_bvh, NodeProbe(query.ray, tree_->operand_bvh.space(), query.ray.origin_error),
       all ? -everywhere : 0.0, to, [&](std::uint32_t operand) {
         if ((tree_->traits[operand] & carrier) == 0) gather_operand(query, operand, all);
         return true;
       });
  return true;
}

/// The operands of a merge that may be met up to the first way in. `to`: how far they are complete.
/// @return false when the start is inside: then the way out is what counts
bool TracedSolid::gather_nearest(Query const& query, double& to) const {
  auto& events = query.scratch.events;
  auto const& operands = tree_->program.operands();
  bool inside = false;
  auto const take = [&](std::uint32_t operand) {
    std::size_t const first = events.size();
    gather_near(query, operands[operand], operand, false);
    auto const begin = events.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, events.end(), [](Event const& a, Event const& b) { return a.t < b.t; });
    std::size_t next = first; // the first event after the start
    for (std::size_t i = first; i < events.size(); ++i) {
      if (events[i].at_start || !(events[i].t > 0)) next = i + 1;
    }
    // Ways in and out alternate: inside when what comes next leads out.
    for (; next < events.size() && !events[next].toggles; ++next) {
    }
    if (next == events.size()) return true;
    Event const& event = events[next];
    inside = !event.entering;
    // Room for other crossings in the same group.
    if (event.visible) to = std::min(to, event.t + 8 * event.error);
    return !inside;
  };
  double const start = 0;
  if (to > query.until) to = query.until;
  walk(tree_->operand_bvh, NodeProbe(query.ray, tree_->operand_bvh.space(), query.ray.origin_error),
       start, to, take);
  return !inside;
}

void TracedSolid::sort_events(Query const& query) const {
  auto& events = query.scratch.events;
  std::sort(events.begin(), events.end(), [](Event const& a, Event const& b) {
    if (a.t != b.t) return a.t < b.t;
    if (a.operand != b.operand) return a.operand < b.operand;
    return a.face < b.face;
  });
  if (events.size() <= few_events) {
    for (std::size_t i = 0; i < events.size(); ++i) {
      bool first = events[i].toggles;
      for (std::size_t j = 0; first && j < i; ++j) {
        first = events[j].operand != events[i].operand || !events[j].toggles;
      }
      if (first) tree_->program.set(*query.state, events[i].operand, !events[i].entering);
    }
    return;
  }
  // The last one written is that of the first crossing.
  for (std::size_t i = events.size(); i-- > 0;) {
    if (events[i].toggles) tree_->program.set(*query.state, events[i].operand, !events[i].entering);
  }
}

/// Applies what is up to the start, and puts it in front. @return the first event after it
std::size_t TracedSolid::pass_start(Query const& query) const {
  auto& events = query.scratch.events;
  auto const apply = [&](Event const& event) {
    if (event.toggles) tree_->program.set(*query.state, event.operand, event.entering);
  };
  std::size_t next = 0;
  std::size_t last_at_start = 0; // one beyond
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].at_start) last_at_start = i + 1;
  }
  for (std::size_t i = 0; i < events.size(); ++i) {
    // Up to the start, and what one operand crosses before something of its own at the start.
    bool before = events[i].at_start || !(events[i].t > 0);
    if (!before && i >= last_at_start) break;
    for (std::size_t j = i + 1; !before && j < last_at_start; ++j) {
      before = events[j].at_start && events[j].operand == events[i].operand;
    }
    if (!before) continue;
    apply(events[i]);
    std::rotate(events.begin() + static_cast<std::ptrdiff_t>(next),
                events.begin() + static_cast<std::ptrdiff_t>(i),
                events.begin() + static_cast<std::ptrdiff_t>(i + 1));
    ++next;
  }
  return next;
}

bool TracedSolid::patch_in_group(Query const& query, std::size_t first, std::size_t last,
                                 Passage& passage) const {
  Event const* shown = nullptr;
  auto const& events = query.scratch.events;
  for (std::size_t i = first; i < last; ++i) {
    Event const& event = events[i];
    if (event.toggles || !event.visible) continue;
    if (shown != nullptr && shown->primitive <= event.primitive) continue;
    if (tree_->program.decides(*query.state, event.operand)) shown = &event;
  }
  if (shown == nullptr) return false;
  passage.crossing = {id_, shown->primitive, shown->face, shown->t, shown->entering, false};
  passage.error = shown->error;
  passage.inside = query.state->value;
  return true;
}

bool TracedSolid::apply_group(Query const& query, std::size_t first, std::size_t last,
                              Passage& passage) const {
  auto const& events = query.scratch.events;
  CsgProgram::State& state = *query.state;
  bool const before = state.value;
  Event const* shown = nullptr;
  auto const prefer = [&](Event const& event) {
    bool const better =
        shown == nullptr
        || (event.visible != shown->visible ? event.visible : event.primitive < shown->primitive);
    if (better) shown = &event;
  };
  bool const several = last - first > 1;
  // Members that by themselves are enough.
  for (std::size_t i = first; several && i < last; ++i) {
    Event const& event = events[i];
    bool const changes = event.toggles && (state.inside[event.operand] != 0) != event.entering;
    if (changes && tree_->program.decides(state, event.operand)) prefer(event);
  }
  for (std::size_t i = first; i < last; ++i) {
    if (events[i].toggles) tree_->program.set(state, events[i].operand, events[i].entering);
  }
  if (state.value == before) return patch_in_group(query, first, last, passage);
  if (!several) shown = &events[first];
  // Members without which nothing would have changed.
  for (std::size_t i = first; several && i < last; ++i) {
    Event const& event = events[i];
    bool const final = event.toggles && (state.inside[event.operand] != 0) == event.entering;
    if (final && tree_->program.decides(state, event.operand)) prefer(event);
  }
  for (std::size_t i = first; shown == nullptr && i < last; ++i) {
    if (events[i].toggles) prefer(events[i]);
  }
  passage.crossing = {id_, shown->primitive, shown->face, shown->t, state.value, true};
  for (std::size_t i = first; i < last; ++i) {
    passage.error = std::max(passage.error, std::fabs(events[i].t - shown->t) + events[i].error);
  }
  passage.visible = shown->visible;
  passage.inside = state.value;
  return true;
}

bool TracedSolid::departs_inside(Query const& query) const {
  if (query.from == nullptr) return false;
  auto const& operands = tree_->program.operands();
  return std::any_of(query.from->on.begin(), query.from->on.end(), [&](Departure::On const& on) {
    return on.was_entering == query.from->through
           && std::binary_search(operands.begin(), operands.end(), on.primitive);
  });
}

void TracedSolid::restore(Query const& query) const {
  for (Event const& event : query.scratch.events) {
    tree_->program.set(*query.state, event.operand, false);
  }
  for (std::uint32_t const operand : tree_->unbounded)
    tree_->program.set(*query.state, operand, false);
}

} // namespace abbe::geometry
