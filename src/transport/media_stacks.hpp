// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"

#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace abbe::transport {

/// What rays are inside of: the solids with an interior, and with fog those that shut it out; the
/// last entered first. Interiors that surfaces share (Stage::interiors) stand in the list in place
/// of solids. Each such list has a number, and equal lists have the same.
class MediaStacks {
public:
  using Id = std::uint32_t;
  static constexpr Id none = 0; ///< in the open

  explicit MediaStacks(Stage const& stage);

  /// What a list has: a solid, or a shared interior.
  using Inside = std::uint32_t;
  static constexpr Inside shared = Inside{1} << 31;

  Id entered(Id stack, Inside inside);
  Id without(Id stack, Inside inside);
  /// Of a point that stands in the solid.
  Id stood_in(Id stack, geometry::SolidId solid) {
    CompiledSolid const& own = stage_.solids[solid];
    return own.by_primitive && own.interior < 0 ? stack : entered(stack, inside_of(solid));
  }
  /// Behind the surfaces of a hit.
  Id after(Id stack, std::span<geometry::SurfaceCrossing const> crossings);
  /// Behind the surface of one solid.
  Id after(Id stack, geometry::RayHit const& hit) {
    CompiledSolid const& own = stage_.solids[hit.solid];
    if (!own.counts()) return stack;
    if (own.turns()) return turned(stack, stage_.interior_of(hit.solid, hit.primitive));
    if (own.open) return after_open(stack, hit.solid);
    if (!hit.toggles) return stack;
    return hit.entering ? entered(stack, inside_of(hit.solid))
                        : without(stack, inside_of(hit.solid));
  }
  /// The one that counts: of the solid of the highest priority, the last entered.
  int medium(Id stack) const { return nodes_[stack].medium; }
  /// The medium whose light fades where one list goes over into the other; 0: none. Of plain
  /// interiors the one that ends, else the one that counted before.
  int left(Id before, Id after) const;
  /// Is the medium that counts a plain interior's?
  bool plain(Id stack) const { return nodes_[stack].plain; }
  /// Is the air, with its fog, there?
  bool in_air(Id stack) const { return !nodes_[stack].shut; }
  /// Of the solid whose medium counts. @pre not none
  int priority(Id stack) const { return nodes_[stack].priority; }
  /// visit(solid), the last entered first, without shared interiors.
  template <class Visit>
  void each_solid(Id stack, Visit&& visit) const {
    for (; stack != none; stack = nodes_[stack].below)
      if ((nodes_[stack].inside & shared) == 0) visit(nodes_[stack].inside);
  }

private:
  struct Node {
    Inside inside = 0;
    Id below = none;
    int medium = 0;                                 ///< of the solid whose medium counts
    int priority = std::numeric_limits<int>::min(); ///< of that solid, if there is one
    Id media = none;    ///< the list without the solids that have no medium
    bool shut = false;  ///< some of them shuts out the air
    bool plain = false; ///< the medium that counts is a plain interior's
  };
  Inside inside_of(geometry::SolidId solid) const {
    std::int32_t const number = stage_.solids[solid].interior;
    return number < 0 ? solid : shared | static_cast<Inside>(number);
  }
  Id after_open(Id stack, geometry::SolidId solid);
  /// Of a shared interior: entered, or left. @param number -1: nothing changes
  Id turned(Id stack, std::int32_t number);
  bool holds(Id stack, Inside inside) const;
  /// Of solids and interiors alike.
  struct Kind {
    bool has_medium, plain, shuts_out_air;
    int medium, priority;
  };
  Kind kind(Inside inside) const;

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
