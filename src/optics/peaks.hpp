// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"
#include "optics/interpolate.hpp"

#include <vector>

namespace abbe::optics {

/// A measured lamp in two parts: what is smooth, and emission lines that its table shows as peaks.
struct SplitTable {
  std::vector<Pair> smooth; ///< [nm, power], as the table; linear between rows
  std::vector<Pair> lines;  ///< [nm, energy]: power times nm
};

/// Takes the peaks off a table [nm, power] that are lines as far as bands and table can tell.
///
/// A peak is a row above both neighbours (or two alike above theirs). It ends where the table rises
/// again, but not further off than twice the width of the band that it is in; its base is the
/// straight line between its two ends (or the table, where that is below). It is a line when what
/// stands above the base
/// - is at half its height no wider than the band: narrower bands show its shape,
/// - and no wider than two steps of the table there: that is how wide a line of no width comes to
/// be
///   in a table of such steps,
/// - is at least as high as its base,
/// - and holds at least 1/200 of the table's energy.
/// Its energy is exactly what stands above the base, its wavelength the centre of that, so smooth
/// and lines together have the table's energy and, for each peak, its first moment.
/// @pre rows ascend, no power is negative
/// @source after Y. Sun, F. D. Fracchia and M. Drew, "A composite model for representing spectral
/// functions", TR 1998-18, Simon Fraser University, 1998
SplitTable split_peaks(std::vector<Pair> const& rows, Bands const& bands);

} // namespace abbe::optics
