// SPDX-License-Identifier: MIT
#include "transport/media_stacks.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

constexpr std::size_t remembered = 256;

} // namespace

MediaStacks::MediaStacks(Stage const& stage) : stage_(stage), nodes_(1), latest_(remembered) {}

MediaStacks::Kind MediaStacks::kind(Inside inside) const {
  if ((inside & shared) == 0) {
    CompiledSolid const& own = stage_.solids[inside];
    return {own.has_medium, own.plain, own.shuts_out_air, own.medium, own.priority};
  }
  SharedInterior const& own = stage_.interiors[inside & ~shared];
  return {true, true, own.shuts_out_air, own.medium, 0};
}

MediaStacks::Id MediaStacks::entered(Id stack, Inside inside) {
  std::uint64_t const key = std::uint64_t{stack} << 32 | inside;
  Latest& latest = latest_[(key ^ key >> 32) % remembered];
  if (latest.key == key) return latest.id;
  auto const [known, fresh] = known_.try_emplace(key, static_cast<Id>(nodes_.size()));
  if (fresh) {
    Kind const own = kind(inside);
    if (own.plain && own.medium == 0 && stack != none && !nodes_[stack].plain) {
      known->second = stack; // what has no interior is nothing in glass { }
      return stack;
    }
    Node node = nodes_[stack];
    node.inside = inside;
    node.below = stack;
    node.shut = node.shut || own.shuts_out_air;
    if (own.has_medium && own.priority >= node.priority) {
      node.medium = own.medium;
      node.priority = own.priority;
      node.plain = own.plain;
    }
    nodes_.push_back(node);
    if (own.has_medium) {
      Id const id = static_cast<Id>(nodes_.size() - 1);
      Id const media = node.media == stack ? id : entered(node.media, inside);
      nodes_[id].media = media;
      latest_[(key ^ key >> 32) % remembered] = {key, id};
      return id;
    }
  }
  latest = {key, known->second};
  return known->second;
}

MediaStacks::Id MediaStacks::without(Id stack, Inside inside) {
  if (stack == none) return none;
  Node const node = nodes_[stack];
  if (node.inside == inside) return node.below;
  Id const rest = without(node.below, inside);
  return rest == node.below ? stack : entered(rest, node.inside);
}

bool MediaStacks::holds(Id stack, Inside inside) const {
  for (; stack != none; stack = nodes_[stack].below)
    if (nodes_[stack].inside == inside) return true;
  return false;
}

MediaStacks::Id MediaStacks::turned(Id stack, std::int32_t number) {
  if (number < 0) return stack;
  Inside const inside = shared | static_cast<Inside>(number);
  return holds(stack, inside) ? without(stack, inside) : entered(stack, inside);
}

int MediaStacks::left(Id before, Id after) const {
  if (nodes_[before].media == nodes_[after].media) return 0;
  // What was in the first list more often than it is in the second.
  for (Id id = before; id != none; id = nodes_[id].below) {
    Kind const own = kind(nodes_[id].inside);
    if (!own.plain || own.medium == 0) continue;
    auto const times = [&](Id list) {
      int count = 0;
      for (; list != none; list = nodes_[list].below)
        count += nodes_[list].inside == nodes_[id].inside;
      return count;
    };
    // Or is in both, of several solids that share it, and a part of the way ends here.
    int const now = times(before), then = times(after);
    if (now > then || (now < then && id == before)) return own.medium;
  }
  return nodes_[before].plain ? 0 : nodes_[before].medium;
}

MediaStacks::Id MediaStacks::after_open(Id stack, geometry::SolidId solid) {
  CompiledSolid const& own = stage_.solids[solid];
  for (Id id = stack; id != none; id = nodes_[id].below) {
    Inside const inside = nodes_[id].inside;
    if ((inside & shared) != 0) continue;
    CompiledSolid const& other = stage_.solids[inside];
    if (own.has_medium ? other.has_medium && other.medium == own.medium : inside == solid)
      return without(stack, inside);
  }
  return entered(stack, solid);
}

MediaStacks::Id MediaStacks::after(Id stack, std::span<geometry::SurfaceCrossing const> crossings) {
  auto const shares = [&](geometry::SurfaceCrossing const& crossing) {
    return stage_.solids[crossing.solid].turns();
  };
  auto const closed = [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return solid.counts() && !solid.open && !shares(crossing) && crossing.toggles;
  };
  for (auto const& crossing : crossings)
    if (closed(crossing) && !crossing.entering) stack = without(stack, inside_of(crossing.solid));
  for (auto const& crossing : crossings)
    if (closed(crossing) && crossing.entering) stack = entered(stack, inside_of(crossing.solid));
  auto const open_medium = [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return solid.has_medium && solid.open && !shares(crossing) ? solid.medium : -1;
  };
  for (auto crossing = crossings.begin(); crossing != crossings.end(); ++crossing) {
    int const medium = open_medium(*crossing);
    // Surfaces that share an interior and meet in the hit are one.
    bool const again = std::any_of(crossings.begin(), crossing, [&](auto const& earlier) {
      return open_medium(earlier) == medium;
    });
    CompiledSolid const& solid = stage_.solids[crossing->solid];
    bool const empty = !solid.has_medium && solid.shuts_out_air && solid.open;
    if (empty || (medium >= 0 && !again)) stack = after_open(stack, crossing->solid);
  }
  auto const number_of = [&](geometry::SurfaceCrossing const& crossing) {
    return shares(crossing) ? stage_.interior_of(crossing.solid, crossing.primitive) : -1;
  };
  for (auto crossing = crossings.begin(); crossing != crossings.end(); ++crossing) {
    std::int32_t const number = number_of(*crossing);
    if (number < 0) continue;
    // Of several that coincide, one counts; one that is entered and one that is left are none.
    auto const of_same = [&](auto const& other) { return number_of(other) == number; };
    if (std::any_of(crossings.begin(), crossing, of_same)) continue;
    if (std::none_of(crossing, crossings.end(), [&](auto const& other) {
          return of_same(other) && other.toggles && other.entering != crossing->entering;
        }))
      stack = turned(stack, number);
  }
  return stack;
}

} // namespace abbe::transport
