// SPDX-License-Identifier: MIT
#pragma once

#include "transport/emitter.hpp"
#include "transport/interface.hpp"

namespace abbe::transport {

class AdaptiveSplits;

/// What policies work with.
struct SplitTools {
  Stage const& stage;
  Arena& arena;
  WaveTables& waves;
  SampleFilm const& film;
  Emitter& emitter;
  AdaptiveSplits& adaptive;
};

/// Rays that a surface splits into their wavelengths.
struct SplitRays {
  Chunk const& chunk;
  double const* light; ///< that goes on, a value a lane
  SplitLanes ways;     ///< and where to
  int wave = 0;        ///< wave table of the split
  int comb = no_comb;
  double tolerance_px = 0;
  /// Does a ray carry enough to go on?
  bool goes_on(std::size_t r, double threshold) const {
    return any_above(light + r * chunk.each, chunk.each, threshold);
  }
};

/// How light goes on that a dispersing material splits: one for each mode. A new one: a file here,
/// and a line in policies.cpp.
class WavelengthPolicy {
public:
  virtual ~WavelengthPolicy() = default;
  virtual void split(SplitTools const& tools, SplitRays const& rays) const = 0;
};

/// Each lane on its own way. @param lane numbers of lanes of the chunk
void send_apart(SplitTools const& tools, SplitRays const& rays, std::uint32_t const* lanes,
                std::size_t count);

/// @param comb of a stochastic mode; null: the deterministic ones
WavelengthPolicy const& policy_of(optics::Comb const* comb, double tolerance_px);

} // namespace abbe::transport
