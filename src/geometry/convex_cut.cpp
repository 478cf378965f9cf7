// SPDX-License-Identifier: MIT
#include "geometry/convex_cut.hpp"

#include "geometry/shapes/convex.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

struct Leaf {
  PrimitiveId primitive;
  bool taken_away;
};

/// The leaves of nested intersections and differences; false for any other tree.
bool flatten(CsgTree const& tree, bool taken_away, std::vector<Leaf>& out) {
  if (tree.op == CsgTree::Op::Primitive) {
    out.push_back({tree.primitive, taken_away != tree.inverse});
    return true;
  }
  bool const difference = tree.op == CsgTree::Op::Difference;
  if (!(difference || tree.op == CsgTree::Op::Intersection)) return false;
  if (taken_away || tree.inverse || tree.children.empty()) return false;
  for (std::size_t i = 0; i < tree.children.size(); ++i) {
    if (!flatten(tree.children[i], difference && i > 0, out)) return false;
  }
  return true;
}

} // namespace

std::unique_ptr<ConvexCut const> ConvexCut::of(CsgTree const& tree, CsgProgram const& program,
                                               std::vector<Placed> const& primitives) {
  std::vector<Leaf> leaves;
  if (!flatten(tree, false, leaves)) return nullptr;
  auto const& operands = program.operands();
  if (leaves.size() != operands.size()) return nullptr; // one of them twice
  auto cut = std::make_unique<ConvexCut>();
  std::sort(leaves.begin(), leaves.end(),
            [](Leaf const& a, Leaf const& b) { return a.primitive < b.primitive; });
  for (std::uint32_t i = 0; i < leaves.size(); ++i) {
    Leaf const& leaf = leaves[i];
    Placed const& placed = primitives[leaf.primitive];
    if (is_plane(placed.shape())) {
      cut->planes_.add(leaf.primitive, placed, leaf.taken_away);
      cut->plane_operands_.push_back(i);
    } else if (placed.shape().one_interval() && !placed.shape().bounds().infinite
               && !leaf.taken_away) {
      cut->others_.push_back({leaf.primitive, i});
      EndsKernel const* const kernel = placed.shape().ends_kernel();
      cut->has_kernels_ = cut->has_kernels_ && kernel != nullptr && kernel->ends_visible();
    } else {
      return nullptr;
    }
  }
  cut->planes_.finish();
  return cut;
}

ConvexCut::Verdict ConvexCut::narrow(LineQuery const& query, Part& part) const {
  auto& events = query.scratch.events;
  for (Operand const& operand : others_) {
    std::size_t const first = events.size();
    gather_near(query, operand.primitive, operand.operand, false);
    if (events.size() != first + 2) return Verdict::Nothing; // bounded, and missed
    std::size_t const in = events[first].entering ? first : first + 1;
    std::size_t const out = 2 * first + 1 - in;
    auto const past = [](Event const& event) { return event.at_start || !(event.t > 0); };
    if (past(events[out])) return Verdict::Nothing;
    if (!past(events[in]) && events[in].t > part.in.t) {
      part.in = {events[in].t, events[in].error, in, false};
    }
    if (events[out].t < part.out.t) part.out = {events[out].t, events[out].error, out, false};
  }
  return Verdict::Something;
}

ConvexCut::Verdict ConvexCut::find(LineQuery const& query, Part& part) const {
  part.in = {-infinity, 0, 0, false};
  part.out = {infinity, 0, 0, false};
  auto const compare = [&] {
    double const apart = part.in.error + part.out.error;
    if (part.in.t - part.out.t > apart || part.in.t - part.in.error > query.until) {
      return Verdict::Nothing;
    }
    return part.out.t - part.in.t > apart ? Verdict::Something : Verdict::Unclear;
  };
  if (!planes_.empty()) {
    HalfSpaceScratch& scratch = query.scratch.half_spaces;
    Verdict const verdict = planes_.common(query.ray, query.from, scratch, part.common);
    if (verdict != Verdict::Something) return verdict;
    part.in = {part.common.in.t, part.common.in.error, part.common.in.plane, true};
    part.out = {part.common.out.t, part.common.out.error, part.common.out.plane, true};
    Verdict const so_far = compare();
    if (so_far != Verdict::Something || others_.empty()) return so_far;
  }
  Verdict const verdict = narrow(query, part);
  return verdict == Verdict::Something ? compare() : verdict;
}

std::optional<std::size_t> ConvexCut::entry(LineQuery const& query, Part const& part) const {
  HalfSpaceScratch const& scratch = query.scratch.half_spaces;
  End const& end = part.in;
  int const near = planes_.entering_near(part.common, end.t, end.error, scratch)
                   + planes_.leaving_near(part.common, end.t, end.error, scratch);
  if (near != (end.by_plane ? 1 : 0)) return std::nullopt;
  return event_of(query, end);
}

std::optional<std::size_t> ConvexCut::exit(LineQuery const& query, Part const& part) const {
  // What enters is before the entry, which stood alone, or before the start.
  End const& end = part.out;
  int const near = planes_.leaving_near(part.common, end.t, end.error, query.scratch.half_spaces);
  if (near != (end.by_plane ? 1 : 0)) return std::nullopt;
  return event_of(query, end);
}

std::optional<std::size_t> ConvexCut::event_of(LineQuery const& query, End const& end) const {
  auto const& events = query.scratch.events;
  std::size_t const count = events.size();
  for (std::size_t i = 0; i < count; ++i) {
    Event const& event = events[i];
    if ((!end.by_plane && i == end.at) || event.at_start || !(event.t > 0)) continue;
    if (std::fabs(event.t - end.t) <= event.error + end.error) return std::nullopt;
  }
  if (!end.by_plane) return end.at;
  gather(query, planes_.primitives()[end.at], plane_operands_[end.at], false);
  return events.size() == count + 1 ? std::optional(count) : std::nullopt;
}

} // namespace abbe::geometry
