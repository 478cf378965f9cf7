// SPDX-License-Identifier: MIT
#pragma once

#include "transport/area_points.hpp"
#include "transport/emitter.hpp"
#include "transport/way.hpp"

#include <map>
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
  /// @return how many ways to places of areas were looked at
  std::uint64_t finish(geometry::Groups const& groups);

private:
  struct Key {
    LightKind kind;
    std::size_t lamp;
    bool thrown = false; ///< light that casters throw is found by itself: none comes straight
    auto operator<=>(Key const&) const = default;
    /// Bits of what lets none pass.
    std::uint8_t opaque() const {
      return static_cast<std::uint8_t>(opaque_shadow_bit | (thrown ? caster_bit : 0));
    }
  };
  void add(Chunk const& chunk, Key const& key, Aim const& aim, RaySet lit, double const* light);
  /// @param lamp that they go to @param opaque bits of what lets none pass
  void finish(Rays& rays, Lamp const& lamp, std::uint8_t opaque, geometry::Groups const& groups);
  /// Ways to places of an area, as many as decide how much of its light comes.
  /// @return how many
  std::uint64_t finish(AreaPoints& points, Lamp const& lamp, std::uint8_t opaque,
                       geometry::Groups const& groups);
  /// The way to a place of the area of point k. @param slot that it has while it is traced
  static void add_way(AreaPoints& points, Area const& area, std::size_t k, std::size_t place,
                      std::size_t slot);
  /// What comes through the lamp's gate goes on as far as the gate; all else is dropped.
  void pass_gate(Rays& rays, geometry::World const& gate);
  /// What fog leaves of light on a piece of its way, where the ray starts in the open.
  void weaken(Rays& rays, std::size_t place, double distance);
  /// Through what filters light. Leaves in `rays` those that go on behind it, as many as it
  /// returns.
  void filter(Rays& rays, Lamp const& lamp, geometry::Groups const& groups);
  /// @param place of a ray among those in work @return false: nothing is left of its light, or it
  /// has arrived
  bool pass(Rays& rays, Lamp const& lamp, std::size_t place, geometry::Groups& starts);
  void arrive(Rays& rays, Lamp const& lamp, std::size_t place);
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
  std::map<Key, AreaPoints> areas_;
  std::vector<double>* arrived_ = nullptr; ///< of ways to places: light goes here, not to the film
  geometry::Hits hits_;
  geometry::Groups starts_[2];
  std::vector<std::uint8_t> blocked_;
  std::vector<std::uint16_t> stuck_; ///< of filtered rays: surfaces passed without any way
  std::vector<std::uint16_t> channels_;
  std::vector<geometry::RayStart> anywhere_;
  std::vector<double> to_gate_;
};

} // namespace abbe::transport
