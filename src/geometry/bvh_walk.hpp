// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/box_probe.hpp"
#include "geometry/bvh.hpp"

#include <bit>
#include <utility>

/// Rays on their way through a hierarchy.
namespace abbe::geometry {

/// Goes to the leaves whose box a probe meets, roughly front to back. Probe: NodeProbe, or FanProbe
/// for several lines.
template <class Probe>
class BvhWalk {
public:
  BvhWalk(Bvh const& bvh, Probe const& probe, double from)
      : nodes_(bvh.nodes().data()), probe_(probe), from_(probe.from(from)) {
    if (!bvh.nodes().empty()) stack_[waiting_++] = {0, BvhNode::inner, from_};
  }
  BvhWalk(BvhWalk const&) = delete;
  BvhWalk& operator=(BvhWalk const&) = delete;

  struct Leaf {
    std::uint32_t first, count; ///< places in the hierarchy's items
  };
  /// The next leaf that begins up to `to`. @return false: there is none
  bool next(double to, Leaf& leaf);
  /// The same in the registers of lanes L.
  template <class L>
  bool next_in(double to, Leaf& leaf) {
    if (waiting_ == 0) return false;
    typename Probe::template Lanes<typename Probe::template LanesOf<L>> const lanes(probe_, from_);
    float const until = probe_.until(to);
    while (waiting_ > 0) {
      Waiting at = stack_[--waiting_];
      if (at.entry > until) continue;
      while (at.count == BvhNode::inner) {
        BvhNode const& node = nodes_[at.first];
        float entry[BvhNode::width];
        __builtin_prefetch(node.first); // what the boxes do not wait for
        unsigned met = lanes.enter(node, until, entry);
        if (met == 0) break;
        auto const part = [&](unsigned k) {
          return Waiting{node.first[k], node.count[k], entry[k]};
        };
        auto const take = [&met] {
          auto const k = static_cast<unsigned>(std::countr_zero(met));
          met &= met - 1;
          return k;
        };
        at = part(take());
        if (met == 0) continue;
        // The nearest is next, the others wait, the farthest at the bottom.
        std::size_t const bottom = waiting_;
        do {
          Waiting other = part(take());
          if (other.entry < at.entry) std::swap(at, other);
          std::size_t place = waiting_++;
          for (; place > bottom && stack_[place - 1].entry < other.entry; --place)
            stack_[place] = stack_[place - 1];
          stack_[place] = other;
        } while (met != 0);
      }
      if (at.count == BvhNode::inner) continue;
      leaf = {at.first, at.count};
      return true;
    }
    return false;
  }

private:
  struct Waiting {
    std::uint32_t first, count; ///< as in BvhNode
    float entry;
  };
  BvhNode const* nodes_;
  Probe const& probe_;
  float from_;
  std::size_t waiting_ = 0;
  Waiting stack_[deepest_bvh * (BvhNode::width - 1) + 1]; ///< nearest on top
};

/// Calls visit(item) for the items whose box the line meets in [from, to], roughly front to back,
/// and for some others; `to` may shrink meanwhile. visit returns false to stop.
/// @param probe made for the hierarchy's space
template <class Probe, class Visit>
void walk(Bvh const& bvh, Probe const& probe, double from, double const& to, Visit&& visit) {
  BvhWalk<Probe> way(bvh, probe, from);
  for (typename BvhWalk<Probe>::Leaf leaf; way.next(to, leaf);) {
    for (std::uint32_t place = leaf.first; place < leaf.first + leaf.count; ++place)
      if (!visit(bvh.items()[place])) return;
  }
}

} // namespace abbe::geometry
