// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh_walk.hpp"
#include "geometry/convex_cut.hpp"
#include "geometry/lane_tree.hpp"
#include "geometry/line_query.hpp"

#include <algorithm>
#include <memory>

/// One solid and the surfaces that a line passes on it, by groups of events (docs/geometry.md):
///
/// 1. All crossings of the whole line with the operands, sorted. Each operand's state at
///    t = -infinity follows from its first crossing (entering: outside before), or from
///    inside(origin) without any.
/// 2. What the ray departs from is applied, not reported: the starts themselves (t == 0), and
///    crossings of other operands with |t| within error. The other roots of a primitive that the
///    ray starts on are never part of it: they are on the side that the departure says.
/// 3. The rest falls into runs of overlapping error intervals [t - error, t + error]. A run of a
///    single primitive is parted again: its own roots come out of one computation, so their order
///    and their being distinct are certain (a thin sphere far away must not vanish). Any other run
///    is one event: all its members change sides, then the boolean value is compared. Lids between
///    coincident faces, A - A, A & A come out right, for both roots of each are in the run or none.
/// 4. Of the members whose own change explains the change (enough by itself before, or undoing it
///    after undoes all), the surface shown is the visible one with the lowest primitive id: a
///    property of the primitives, not of the order of operands.
namespace abbe::geometry {

inline constexpr double everywhere = std::numeric_limits<double>::infinity();

class TracedSolid {
public:
  TracedSolid(World::Solid const& source, std::vector<Placed> const& primitives, SolidId id);

  std::uint8_t mask() const { return mask_; }
  /// Null: those of the one primitive.
  Bounds const* bounds() const { return bounds_.get(); }
  bool has_program() const { return tree_ != nullptr; }
  CsgProgram const* program() const { return tree_ ? &tree_->program : nullptr; }
  /// Without a program: the one primitive (inverse(): inside and outside swapped).
  PrimitiveId only() const { return only_; }
  /// Of the one primitive where it is a convex shape: what can be seen of it. Else null.
  EndsKernel const* ends() const { return ends_; }
  bool inverse() const { return inverse_; }
  /// For fan_cut.hpp and lane_tree.hpp, or null.
  ConvexCut const* fan_cut() const { return tree_ ? tree_->fan_cut : nullptr; }
  LaneTree const* lane_tree() const { return tree_ ? tree_->lanes.get() : nullptr; }

  /// What is reported of a solid on a line, ascending in t: a change of inside (toggles; perhaps
  /// not visible) or a patch. Members are scratch.events[first, last).
  struct Passage {
    SurfaceCrossing crossing;
    double error = 0;
    bool visible = true;
    bool inside = false; ///< of the solid, after it
    std::size_t first = 0, last = 0;
  };
  using Query = LineQuery;
  /// Calls take(passage) for all passages with t > 0 beyond the departure, or, when `all`, for all
  /// of the line; take returns false to stop. @return when `all`: inside at the line's beginning
  template <class Take>
  bool passages(Query const& query, bool all, Take&& take) const;

private:
  template <class Take>
  bool single(Query const& query, Take& take) const;
  template <class Take>
  void single_ahead(Query const& query, Take& take) const;
  /// The short way of ConvexCut. @return how many passages were taken, or `all_taken`
  template <class Take>
  std::size_t convex(Query const& query, Take& take) const;
  /// That of a merge met from outside: operands up to the first way in. @return as convex()
  template <class Take>
  std::size_t nearest(Query const& query, Take& take) const;
  static constexpr std::size_t all_taken = static_cast<std::size_t>(-1);
  template <class Take>
  bool boolean(Query const& query, bool all, Take& take) const;
  /// Groups of the sorted events from `next` on; false when one reaches beyond `to`.
  template <class Take>
  bool groups(Query const& query, std::size_t next, double to, Take& take) const;
  /// @return false when there is nothing of the solid on the wanted part of the line
  bool gather_operands(Query const& query, bool all) const;
  void gather_operand(Query const& query, std::uint32_t operand, bool all) const;
  bool gather_nearest(Query const& query, double& to) const;
  /// Sorts, and puts the state to that at t = -infinity.
  void sort_events(Query const& query) const;
  std::size_t pass_start(Query const& query) const;
  bool apply_group(Query const& query, std::size_t first, std::size_t last, Passage& passage) const;
  bool patch_in_group(Query const& query, std::size_t first, std::size_t last,
                      Passage& passage) const;
  void restore(Query const& query) const;
  /// Does the ray depart to the inside of an operand? Then it starts inside of a merge.
  bool departs_inside(Query const& query) const;

  /// What a boolean tree has and a single primitive does not need.
  struct Tree {
    explicit Tree(CsgTree const& tree) : program(tree) {}
    CsgProgram program;
    std::unique_ptr<ConvexCut const> cut;  ///< when the tree is of its kind
    ConvexCut const* fan_cut = nullptr;    ///< that, when its operands have kernels
    std::unique_ptr<LaneTree const> lanes; ///< else, when of its kind
    bool merge = false;                    ///< of primitives alone, and with a hierarchy
    Bvh operand_bvh;                       ///< over finite operands when there are many
    std::vector<std::uint32_t> always;     ///< operands tested for each ray, but carriers
    /// Bounded operands outside of all of which the line is outside of the solid; none when there
    /// are no such or many. They come first: where they have no crossing, nothing has.
    std::vector<std::uint32_t> carriers;
    std::vector<std::uint32_t> unbounded; ///< operands that a whole line may be in
    std::vector<std::uint8_t> traits;     ///< by operand: of these two
  };
  static std::unique_ptr<Tree const> make_tree(CsgTree const& source,
                                               std::vector<Placed> const& primitives);

  SolidId id_;
  PrimitiveId only_ = 0; ///< without a tree: the one primitive
  std::uint8_t mask_;
  bool inverse_ = false;
  bool convex_ = false; ///< of the one primitive: a line that leaves it does not come back
  std::unique_ptr<Tree const> tree_;
  EndsKernel const* ends_ = nullptr;
  std::unique_ptr<Bounds const> bounds_; ///< not of one convex shape: asked for once
};

/// Bounds of a boolean tree: an intersection lies in what its children have in common, a difference
/// and a clipped solid in the first child.
Bounds bounds_of(CsgTree const& tree, std::vector<Placed> const& primitives);

template <class Take>
bool TracedSolid::passages(Query const& query, bool all, Take&& take) const {
  query.scratch.events.clear();
  if (!tree_) {
    if (all) return single(query, take);
    single_ahead(query, take);
    return false;
  }
  if (all || !(tree_->cut || tree_->merge)) return boolean(query, all, take);
  std::size_t taken = tree_->cut              ? convex(query, take)
                      : departs_inside(query) ? 0
                                              : nearest(query, take);
  if (taken == all_taken) return false;
  // What the short way could not tell, the general way does from the start.
  query.scratch.events.clear();
  auto rest = [&](Passage const& passage) { return taken > 0 ? (--taken, true) : take(passage); };
  return boolean(query, all, rest);
}

template <class Take>
std::size_t TracedSolid::convex(Query const& query, Take& take) const {
  ConvexCut::Part part;
  ConvexCut::Verdict const verdict = tree_->cut->find(query, part);
  if (verdict == ConvexCut::Verdict::Nothing) return all_taken;
  if (verdict == ConvexCut::Verdict::Unclear) return 0;
  auto const pass = [&](std::size_t place, bool inside) {
    Event const& event = query.scratch.events[place];
    return take(Passage{{id_, event.primitive, event.face, event.t, inside, true},
                        event.error,
                        event.visible,
                        inside,
                        place,
                        place + 1});
  };
  bool const enters = part.in.t > -everywhere;
  if (enters) {
    auto const entry = tree_->cut->entry(query, part);
    if (!entry) return 0;
    if (!pass(*entry, true)) return all_taken;
  }
  if (!(part.out.t < everywhere) || part.out.t - part.out.error > query.until) return all_taken;
  auto const exit = tree_->cut->exit(query, part);
  if (!exit) return enters ? 1 : 0;
  pass(*exit, false);
  return all_taken;
}

template <class Take>
void TracedSolid::single_ahead(Query const& query, Take& take) const {
  Start start;
  bool const starts = find_start(query.from, only_, start);
  Placed const& placed = query.primitives[only_];
  if (starts ? convex_ && !start.to_inside : placed.misses(query.ray, query.until)) return;
  Crossings& crossings = query.scratch.crossings;
  crossings.clear();
  auto& events = query.scratch.events;
  Ray const ray = placed.to_object(query.ray);
  placed.shape().crossings_ahead(ray, starts ? &start : nullptr, query.until, crossings);
  sort_few(crossings);
  bool inside = false, known = false;
  for (Crossing const& c : crossings) {
    check_error(placed.shape(), ray, c);
    if (!(c.t > 0) || at_start(query, starts, c)) continue;
    bool const entering = c.entering != inverse_;
    // A grazing start can leave a root without its partner: a second entry is none.
    if (c.toggles && known && entering == inside) continue;
    if (c.toggles) {
      inside = entering;
      known = true;
    }
    events.push_back(
        {c.t, group_margin * c.error, only_, 0, c.face, c.entering, c.toggles, c.visible, false});
    std::size_t const place = events.size() - 1;
    if (!take(Passage{{id_, only_, c.face, c.t, entering, c.toggles},
                      group_margin * c.error,
                      c.visible,
                      inside,
                      place,
                      place + 1})) {
      return;
    }
  }
}

template <class Take>
bool TracedSolid::single(Query const& query, Take& take) const {
  gather(query, only_, 0, false);
  auto& events = query.scratch.events;
  sort_few(events);
  Event const* first = nullptr;
  for (Event const& event : events) {
    if (event.toggles && first == nullptr) first = &event;
  }
  Placed const& placed = query.primitives[only_];
  bool inside = (first != nullptr ? !first->entering
                                  : placed.shape().inside(placed.to_object(query.ray.origin)))
                != inverse_;
  bool const before = inside;
  for (std::size_t i = 0; i < events.size(); ++i) {
    Event const& event = events[i];
    bool const entering = event.entering != inverse_;
    if (event.toggles && entering == inside) continue;
    if (event.toggles) inside = entering;
    Passage const passage{{id_, only_, event.face, event.t, entering, event.toggles},
                          event.error,
                          event.visible,
                          inside,
                          i,
                          i + 1};
    if (!take(passage)) break;
  }
  return before;
}

template <class Take>
std::size_t TracedSolid::nearest(Query const& query, Take& take) const {
  double to = everywhere;
  if (!gather_nearest(query, to)) return 0;
  if (query.scratch.events.empty()) return all_taken;
  sort_events(query);
  std::size_t taken = 0;
  auto const counted = [&](Passage const& passage) {
    ++taken;
    return take(passage);
  };
  std::size_t const next = pass_start(query);
  bool const done = !query.state->value && groups(query, next, to, counted);
  restore(query);
  return done ? all_taken : taken;
}

template <class Take>
bool TracedSolid::boolean(Query const& query, bool all, Take& take) const {
  if (!gather_operands(query, all)) return false;
  sort_events(query);
  std::size_t const next = all ? 0 : pass_start(query);
  bool const before = query.state->value;
  groups(query, next, everywhere, take);
  restore(query);
  return before;
}

template <class Take>
bool TracedSolid::groups(Query const& query, std::size_t next, double to, Take& take) const {
  auto& events = query.scratch.events;
  while (next < events.size()) {
    std::size_t last = next + 1;
    double begin = events[next].t - events[next].error;
    double end = events[next].t + events[next].error;
    bool mixed = false;
    while (last < events.size() && events[last].t - events[last].error <= end) {
      mixed = mixed || events[last].primitive != events[next].primitive;
      begin = std::min(begin, events[last].t - events[last].error);
      end = std::max(end, events[last].t + events[last].error);
      ++last;
    }
    if (begin - (end - begin) > query.until) return true; // whichever member is shown
    if (end > to) return false;
    std::size_t const step = mixed ? last - next : 1;
    for (; next < last; next += step) {
      Passage passage;
      passage.first = next;
      passage.last = next + step;
      if (!apply_group(query, next, next + step, passage)) continue;
      passage.crossing.solid = id_;
      if (!take(passage)) return true;
    }
  }
  return !(to < query.until);
}

} // namespace abbe::geometry
