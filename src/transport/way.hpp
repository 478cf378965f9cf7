// SPDX-License-Identifier: MIT
#pragma once

#include "transport/media_stacks.hpp"
#include "transport/rays.hpp"

namespace abbe::transport {

/// The way of a ray from where it starts to what it meets, through what it is inside of.
class Way {
public:
  Way(Stage const& stage, MediaStacks& stacks) : stage_(stage), stacks_(stacks) {}

  /// Does a ray inside of these come to bounds on its way that are not surfaces? Solids that leak
  /// end there, and a ray that escapes has left all that are bounded.
  bool has_stops(MediaStacks::Id stack, bool escapes) const {
    return stack != MediaStacks::none && (escapes || stage_.has_leaks);
  }
  struct End {
    MediaStacks::Id stack; ///< what it is inside of then
    double rest;           ///< how far it goes in its last medium
  };
  /// Takes the light as far as the last of these bounds.
  /// @param distance to what it meets; infinite: it escapes @param travelled before its start
  End to_last_stop(geometry::Ray const& line, MediaStacks::Id stack, double distance,
                   double travelled, Passage passage);
  /// All that a medium does along a piece of a way.
  static void along(Medium const& medium, Passage const& passage) {
    for (auto const& segment : medium.segments) segment->along(passage);
  }
  /// All that it does where it is left.
  static void leave(Medium const& medium, Passage const& passage) {
    for (auto const& segment : medium.segments) segment->leave(passage);
  }

private:
  Stage const& stage_;
  MediaStacks& stacks_;
};

/// Takes surfaces out of a hit that lie where a medium of higher priority displaces theirs.
/// @return what it leaves: false: nothing
bool drop_displaced(Stage const& stage, MediaStacks const& stacks, MediaStacks::Id before,
                    MediaStacks::Id after, geometry::RayHit& hit, geometry::HitGroup* group);

/// The channels of a ray's lanes, one by one.
inline void channels_of(Rays const& rays, std::size_t place, std::uint16_t* out) {
  std::size_t const n = rays.kind().size();
  if (rays.kind().listed())
    std::copy_n(rays.channels.data() + place * n, n, out);
  else
    for (std::size_t c = 0; c < n; ++c)
      out[c] = static_cast<std::uint16_t>(rays.channel[place] + c);
}

} // namespace abbe::transport
