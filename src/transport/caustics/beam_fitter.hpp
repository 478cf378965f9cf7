// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/beam_map.hpp"
#include "transport/caustics/emission.hpp"
#include "transport/caustics/forced.hpp"

#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// Cuts sheets into pieces, in which polynomials tell where rays go (BeamMap).
class BeamFitter {
public:
  /// @param spectrum waves from one end of it to the other, evenly
  BeamFitter(ForcedPaths& forced, Emission const& emission, std::vector<int> const& spectrum)
      : forced_(forced), emission_(emission), spectrum_(spectrum) {}
  /// Appends the pieces of a sheet. Those that no polynomials tell well enough stay without
  /// (Sheet::map).
  void cut(Chain const& chain, Sheet const& sheet, std::vector<Sheet>& sheets,
           std::vector<BeamMap>& maps);

private:
  enum class Verdict { Fits, CutCell, CutSpectrum, Nowhere };
  Verdict fit(Chain const& chain, Sheet const& sheet, BeamMap& map);
  void cut(Chain const& chain, Sheet const& sheet, int depth, std::vector<Sheet>& sheets,
           std::vector<BeamMap>& maps);
  /// Rays at places of a cell. @return false: some are not there
  bool trace(Chain const& chain, Sheet const& sheet, std::span<Vec2 const> at, int wave,
             std::span<BeamMap::Ray> out);
  bool trace_nine(Chain const& chain, Sheet const& sheet, int wave, std::array<BeamRay, 9>& out);
  /// The wave at sixteenths of the sheet's piece of the spectrum.
  int wave_at(Chain const& chain, Sheet const& sheet, int sixteenths) const;

  ForcedPaths& forced_;
  Emission const& emission_;
  std::vector<int> const& spectrum_;
  ForcedRays rays_;
};

} // namespace abbe::transport::caustics
