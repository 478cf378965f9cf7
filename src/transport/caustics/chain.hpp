// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "geometry/world.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abbe::transport::caustics {

/// One surface on the way of light from a lamp, and how it went on there.
struct Step {
  geometry::PrimitiveId primitive = 0;
  geometry::SolidId solid = 0; ///< whose surface it is; not compared
  std::uint32_t face = 0; ///< of a flat one; else 0, as a curved surface is one whatever its faces
  bool flat = false;
  bool entering = false;     ///< the primitive
  bool mirror = false;       ///< it came back; else it went through
  bool bends = false;        ///< the surface is a caster's: it makes caustics
  int before = 0, after = 0; ///< media
  Vec3 point{0}, normal{0};  ///< of a flat one: its plane, which has no edge here; not compared
  bool same(Step const& other) const {
    return primitive == other.primitive && face == other.face && flat == other.flat
           && entering == other.entering && mirror == other.mirror && bends == other.bends
           && before == other.before && after == other.after;
  }
};

/// The steps of a path up to the last surface that bends or mirrors it: light of one chain goes
/// through the same surfaces in the same order, so it makes one smooth map from directions of the
/// lamp to rays.
struct Chain {
  std::vector<Step> steps;
  int parent = 0;
  bool bends = false;     ///< some step is a caster's
  bool disperses = false; ///< its rays depend on the wavelength
  bool coloured = false;  ///< what it leaves of light depends on the channel by more than the index
  /// What it leaves of light is told by Fresnel's equations and by ways in media that absorb.
  bool plain = true;
  std::vector<int> absorbing; ///< these media, of a plain one
};

/// Media that absorb light of a plain chain, at most.
inline constexpr std::size_t most_absorbing = 2;

/// All chains that were met; number 0 is the empty one.
class ChainTable {
public:
  ChainTable() : chains_(1) {}
  Chain const& operator[](int chain) const { return chains_[static_cast<std::size_t>(chain)]; }
  int count() const { return static_cast<int>(chains_.size()); }
  /// What a step does to wavelengths.
  struct Colours {
    bool disperses = false; ///< it bends them apart
    bool coloured = false;  ///< it, or the way to it, takes of some more than of others
    bool plain = false;     ///< Chain::plain, with the way to it
    int absorbing = -1;     ///< the medium of that way, where it absorbs; -1: it does not
  };
  /// The chain with one step more.
  int extended(int chain, Step const& step, Colours const& colours);

private:
  static std::uint64_t key(int chain, Step const& step);
  std::vector<Chain> chains_;
  std::unordered_multimap<std::uint64_t, int> known_;
};

} // namespace abbe::transport::caustics
