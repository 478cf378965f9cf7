// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"

#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace abbe::transport {

/// What rays are inside of: the solids with an interior, and with fog those that shut it out; the
/// last entered first. Each such list has a number, and equal lists have the same.
class MediaStacks {
public:
  using Id = std::uint32_t;
  static constexpr Id none = 0; ///< in the open

  explicit MediaStacks(Stage const& stage);

  Id entered(Id stack, geometry::SolidId solid);
  Id without(Id stack, geometry::SolidId solid);
  /// Behind the surfaces of a hit.
  Id after(Id stack, std::span<geometry::SurfaceCrossing const> crossings);
  /// Behind the surface of one solid.
  Id after(Id stack, geometry::SolidId solid, bool entering, bool toggles) {
    CompiledSolid const& own = stage_.solids[solid];
    if (!own.counts()) return stack;
    if (own.open) return after_open(stack, solid);
    if (!toggles) return stack;
    return entering ? entered(stack, solid) : without(stack, solid);
  }
  /// The one that counts: of the solid of the highest priority, the last entered.
  int medium(Id stack) const { return nodes_[stack].medium; }
  /// Does it end or begin in a medium that the other has not?
  bool moves(Id before, Id after) const { return nodes_[before].media != nodes_[after].media; }
  /// Is the air, with its fog, there?
  bool in_air(Id stack) const { return !nodes_[stack].shut; }
  /// Of the solid whose medium counts. @pre not none
  int priority(Id stack) const { return nodes_[stack].priority; }
  /// visit(solid), the last entered first.
  template <class Visit>
  void each(Id stack, Visit&& visit) const {
    for (; stack != none; stack = nodes_[stack].below) visit(nodes_[stack].solid);
  }

private:
  struct Node {
    geometry::SolidId solid = 0;
    Id below = none;
    int medium = 0;                                 ///< of the solid whose medium counts
    int priority = std::numeric_limits<int>::min(); ///< of that solid, if there is one
    Id media = none;   ///< the list without the solids that have no medium
    bool shut = false; ///< some of them shuts out the air
  };
  Id after_open(Id stack, geometry::SolidId solid);

  Stage const& stage_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, Id> known_;
  struct Latest {
    std::uint64_t key = ~std::uint64_t{0};
    Id id = none;
  };
  std::vector<Latest> latest_; ///< of entered(), by a hash of what was asked
};

} // namespace abbe::transport
