// SPDX-License-Identifier: MIT
#pragma once

#include "transport/emitter.hpp"
#include "transport/way.hpp"

#include <vector>

namespace abbe::transport {

/// Rays on their way from surfaces to lamps, each with the light that its lamp adds there unless
/// something is between.
class Shadows {
public:
  Shadows(Stage const& stage, Arena& arena, geometry::Scratch& scratch, SampleFilm& film,
          MediaStacks& stacks, Paths& paths);

  /// @param lit rays whose surface the lamp lights @param light what it adds, a value a lane
  void add(Chunk const& chunk, std::size_t lamp, Aim const& aim, RaySet lit, double const* light);
  /// All of them arrive, or do not. @param groups that they start from
  void finish(geometry::Groups const& groups);

private:
  struct Key {
    LightKind kind;
    std::size_t lamp;
    auto operator<=>(Key const&) const = default;
  };
  void finish(Rays& rays, geometry::Groups const& groups);
  /// Through what filters light. Leaves in `rays` those that go on behind it, as many as it
  /// returns.
  void filter(Rays& rays, geometry::Groups const& groups);
  /// @param place of a ray among those in work @return false: nothing is left of its light, or it
  /// has arrived
  bool pass(Rays& rays, std::size_t place, geometry::Groups& starts);
  void arrive(Rays& rays, std::size_t place);
  void add_to_film(Rays const& rays, std::size_t place);
  Passage passage(Rays& rays, std::size_t place, double const* distance);

  Stage const& stage_;
  Arena& arena_;
  geometry::Scratch& scratch_;
  SampleFilm& film_;
  MediaStacks& stacks_;
  Paths& paths_;
  Way way_;
  Rays::Fields fields_;
  Queues<Key> queues_;
  geometry::Hits hits_;
  geometry::Groups starts_[2];
  std::vector<std::uint8_t> blocked_;
  std::vector<std::uint16_t> channels_;
};

} // namespace abbe::transport
