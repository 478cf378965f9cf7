// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/convex_cut.hpp"
#include "geometry/fan_cut.hpp"
#include "geometry/shapes/gap_kernel.hpp"

#include <array>
#include <memory>

/// Any boolean tree of few operands, asked for lines side by side. Each operand that may be met is
/// asked where the lines go in and out of it; from one end to the next the tree's value is computed
/// anew in all lanes, until it has changed. As in fan_cut.hpp, an end that is not clear of all
/// others, by error intervals, decides nothing: the general way does (TracedSolid), whose answers
/// these are.
namespace abbe::geometry {

class LaneTree {
public:
  static constexpr std::size_t most_operands = 24;

  /// @return null when there are more leaves than that, or one is a patch, or unbounded without a
  /// kernel
  static std::unique_ptr<LaneTree const> of(CsgTree const& tree, CsgProgram const& program,
                                            std::vector<Placed> const& primitives);

  struct Operand {
    PrimitiveId primitive;
    /// Both are null of other shapes, for which the lanes must not come near it.
    EndsKernel const* kernel;
    GapKernel const* gap; ///< that of a shape without the first
    Bounds bounds;
    bool bounded() const { return !bounds.infinite; }
    bool hidden; ///< only there to clip
  };
  std::span<Operand const> operands() const { return operands_; }

  /// The tree's value. @param inside of each operand
  template <class Mask>
  Mask value(std::array<Mask, most_operands> const& inside) const {
    std::array<Mask, most_operands + 1> stack;
    std::size_t top = 0; // one beyond
    for (Step const& step : steps_) {
      switch (step.kind) {
      case Step::Kind::Operand:
        stack[top++] = inside[step.operand];
        break;
      case Step::Kind::Both:
        --top;
        stack[top - 1] = lane::both(stack[top - 1], stack[top]);
        break;
      case Step::Kind::Either:
        --top;
        stack[top - 1] = lane::either(stack[top - 1], stack[top]);
        break;
      case Step::Kind::Negate:
        stack[top - 1] = lane::negate(stack[top - 1]);
        break;
      }
    }
    return stack[0];
  }

private:
  struct Step {
    enum class Kind : std::uint8_t { Operand, Both, Either, Negate } kind;
    std::uint8_t operand = 0;
  };
  /// Appends the steps of a subtree. @return false when there are too many leaves, or an empty node
  bool flatten(CsgTree const& tree, CsgProgram const& program);

  std::vector<Operand> operands_;
  std::vector<Step> steps_; ///< postfix
  std::size_t leaves_ = 0;
};

/// What the operands of a tree are to all rays of a fan.
struct TreeOperands {
  struct Near {
    std::size_t operand;
    double place, seen; ///< the same for lanes; 0: it is hidden, 1: not
    bool starts;        ///< the rays start on it
    Start start;
  };
  std::array<Near, LaneTree::most_operands> near; ///< those that may be met
  std::size_t count = 0;
  /// @param misses of a bounded operand that the rays do not start on: none of them comes near it
  /// @return false when one that may be met has no kernel
  template <class Misses>
  bool find(LaneTree const& tree, Departure const* from, Misses const& misses) {
    for (std::size_t i = 0; i < tree.operands().size(); ++i) {
      LaneTree::Operand const& operand = tree.operands()[i];
      Near& next = near[count];
      next.starts = find_start(from, operand.primitive, next.start);
      if (!next.starts && operand.bounded() && misses(operand)) continue;
      if (operand.kernel == nullptr && (operand.gap == nullptr || next.starts)) return false;
      next.operand = i;
      next.place = static_cast<double>(i);
      next.seen = operand.hidden ? 0.0 : 1.0;
      ++count;
    }
    return true;
  }
};

/// Where the tree's value changes first after the start, to be seen.
template <class L>
struct TreeEnd {
  using Mask = decltype(L() < L());
  Mask unclear;         ///< ask for this ray alone
  Mask found;           ///< not unclear, and there is one
  Mask enters, entered; ///< the operand; the solid
  L operand, t, error, face;
  L after; ///< where the next end of any operand begins, or before
};

/// Ends that are nearer to each other than so many times their errors are left to the way of single
/// rays: more than 1, to know that another solid's crossing is clear of what follows.
inline constexpr double clearance = 8;

/// @param until lanes where the next end begins after it look no further
template <class L>
TreeEnd<L> first_end_of(LaneTree const& tree, TreeOperands const& operands,
                        std::vector<Placed> const& primitives, LaneRays<L> const& rays,
                        bool departs, L const& until) {
  using Mask = typename TreeEnd<L>::Mask;
  L const zero(0.0), one(1.0), far(infinity);
  Mask const no = one < zero;
  std::array<Ends<L>, LaneTree::most_operands> all;
  std::array<Mask, LaneTree::most_operands> inside;
  std::array<L, LaneTree::most_operands> outside; // 1: between the ends it is outside
  for (std::size_t k = 0; k < tree.operands().size(); ++k) inside[k] = no;
  std::size_t const count = operands.count;
  Mask alike = no;
  auto const either_but_both = [](Mask const& a, Mask const& b) {
    return lane::either(lane::both(a, lane::negate(b)), lane::both(b, lane::negate(a)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    TreeOperands::Near const& near = operands.near[i];
    LaneTree::Operand const& operand = tree.operands()[near.operand];
    Ends<L>& ends = all[i];
    outside[i] = zero;
    if (Placed const& placed = primitives[operand.primitive]; operand.kernel != nullptr) {
      operand.kernel->ends(placed.line<L>(rays.origin, rays.direction),
                           near.starts ? &near.start : nullptr, ends);
    } else {
      Gap<L> gap;
      operand.gap->gap(placed.line<L>(rays.origin, rays.direction), gap);
      ends = gap.between;
      outside[i] = gap.outside;
      alike = lane::either(alike, zero < gap.alike);
    }
    // What is at the start, or behind it, is done with; what has its end there is not met.
    L const blurred = near.starts || !departs ? zero : one;
    auto const past = [&](L const& t, L const& error) { return t <= blurred * error; };
    Mask const met =
        lane::both(ends.in_t < ends.out_t, lane::negate(past(ends.out_t, ends.out_error)));
    Mask const begun = past(ends.in_t, ends.in_error);
    ends.in_t = lane::select(met, lane::select(begun, -far, ends.in_t), far);
    ends.out_t = lane::select(met, ends.out_t, far);
    ends.in_error = L(group_margin) * ends.in_error;
    ends.out_error = L(group_margin) * ends.out_error;
    inside[near.operand] = either_but_both(lane::both(met, begun), zero < outside[i]);
  }
  Mask value = tree.value(inside), pending = lane::negate(alike);
  TreeEnd<L> first{alike, no, no, no, -one, far, zero, zero, far};
  L done = zero; // how far along the line
  for (;;) {
    L t = far, error = zero, face = zero, place = -one, enters = zero, seen = zero;
    for (std::size_t i = 0; i < count; ++i) {
      Ends<L> const& ends = all[i];
      L const here(operands.near[i].place), visible(operands.near[i].seen);
      auto const take = [&](L const& its_t, L const& its_error, L const& its_face, L const& in) {
        Mask const nearer = lane::both(done < its_t, its_t < t);
        t = lane::select(nearer, its_t, t);
        error = lane::select(nearer, its_error, error);
        face = lane::select(nearer, its_face, face);
        enters = lane::select(nearer, in, enters);
        place = lane::select(nearer, here, place);
        seen = lane::select(nearer, visible, seen);
      };
      take(ends.in_t, ends.in_error, ends.in_face, one - outside[i]);
      take(ends.out_t, ends.out_error, ends.out_face, outside[i]);
    }
    pending = lane::both(pending, lane::both(t < far, t - error <= until));
    if (lane::none(pending)) return first;
    L crowd = zero;
    for (std::size_t i = 0; i < count; ++i) {
      Ends<L> const& ends = all[i];
      auto const near = [&](L const& its_t, L const& its_error) {
        return lane::select(lane::abs(its_t - t) <= L(clearance) * (its_error + error), one, zero);
      };
      crowd = crowd + near(ends.in_t, ends.in_error) + near(ends.out_t, ends.out_error);
      inside[operands.near[i].operand] =
          either_but_both(lane::both(ends.in_t <= t, t < ends.out_t), zero < outside[i]);
    }
    Mask const crowded = lane::both(pending, one < crowd);
    first.unclear = lane::either(first.unclear, crowded);
    pending = lane::both(pending, lane::negate(crowded));
    Mask const after = tree.value(inside);
    Mask const changed = either_but_both(after, value);
    Mask const shown = lane::both(pending, lane::both(changed, zero < seen));
    first.found = lane::either(first.found, shown);
    first.enters = lane::either(first.enters, lane::both(shown, zero < enters));
    first.entered = lane::either(first.entered, lane::both(shown, after));
    first.operand = lane::select(shown, place, first.operand);
    first.t = lane::select(shown, t, first.t);
    first.error = lane::select(shown, error, first.error);
    first.after = lane::select(shown, t + L(clearance) * error, first.after);
    first.face = lane::select(shown, face, first.face);
    pending = lane::both(pending, lane::negate(shown));
    if (lane::none(pending)) return first;
    value = after;
    done = t;
  }
}

} // namespace abbe::geometry
