// SPDX-License-Identifier: MIT
#include "transport/media_stacks.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

constexpr std::size_t remembered = 256;

} // namespace

MediaStacks::MediaStacks(Stage const& stage) : stage_(stage), nodes_(1), latest_(remembered) {}

MediaStacks::Id MediaStacks::entered(Id stack, geometry::SolidId solid) {
  std::uint64_t const key = std::uint64_t{stack} << 32 | solid;
  Latest& latest = latest_[(key ^ key >> 32) % remembered];
  if (latest.key == key) return latest.id;
  auto const [known, fresh] = known_.try_emplace(key, static_cast<Id>(nodes_.size()));
  if (fresh) {
    CompiledSolid const& own = stage_.solids[solid];
    Node node = nodes_[stack];
    node.solid = solid;
    node.below = stack;
    node.shut = node.shut || own.shuts_out_air;
    if (own.has_medium && own.priority >= node.priority) {
      node.medium = own.medium;
      node.priority = own.priority;
    }
    nodes_.push_back(node);
    if (own.has_medium) {
      Id const id = static_cast<Id>(nodes_.size() - 1);
      Id const media = node.media == stack ? id : entered(node.media, solid);
      nodes_[id].media = media;
      latest_[(key ^ key >> 32) % remembered] = {key, id};
      return id;
    }
  }
  latest = {key, known->second};
  return known->second;
}

MediaStacks::Id MediaStacks::without(Id stack, geometry::SolidId solid) {
  if (stack == none) return none;
  Node const node = nodes_[stack];
  if (node.solid == solid) return node.below;
  Id const rest = without(node.below, solid);
  return rest == node.below ? stack : entered(rest, node.solid);
}

MediaStacks::Id MediaStacks::after_open(Id stack, geometry::SolidId solid) {
  CompiledSolid const& own = stage_.solids[solid];
  for (Id id = stack; id != none; id = nodes_[id].below) {
    CompiledSolid const& other = stage_.solids[nodes_[id].solid];
    if (own.has_medium ? other.has_medium && other.medium == own.medium : nodes_[id].solid == solid)
      return without(stack, nodes_[id].solid);
  }
  return entered(stack, solid);
}

MediaStacks::Id MediaStacks::after(Id stack, std::span<geometry::SurfaceCrossing const> crossings) {
  auto const closed = [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return solid.counts() && !solid.open && crossing.toggles;
  };
  for (auto const& crossing : crossings)
    if (closed(crossing) && !crossing.entering) stack = without(stack, crossing.solid);
  for (auto const& crossing : crossings)
    if (closed(crossing) && crossing.entering) stack = entered(stack, crossing.solid);
  auto const open_medium = [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return solid.has_medium && solid.open ? solid.medium : -1;
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
  return stack;
}

} // namespace abbe::transport
