// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "transport/chunk.hpp"
#include "transport/sample_film.hpp"

namespace abbe::transport {

/// Light of a chunk that meets its first stochastic material, parted into what goes on at the drawn
/// wavelengths and its control light. Arrays are in the arena.
class CombLight {
public:
  CombLight(WaveTables& waves, SampleFilm const& film, Arena& arena)
      : waves_(waves), film_(film), arena_(arena) {}

  /// A lane a tooth.
  ChunkLight teeth(Chunk const& chunk, int comb) const;
  /// The published scheme: every lane becomes two, of the bands that its wavelength falls between.
  /// @param light a value a lane
  ChunkLight doubled(Chunk const& chunk, double const* light, int comb) const;
  /// The same lanes on other slots.
  ChunkLight control(Chunk const& chunk, int comb) const;

private:
  WaveTables& waves_;
  SampleFilm const& film_;
  Arena& arena_;
};

} // namespace abbe::transport
