// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace abbe::optics {

/// What a catalogue gave, and what in it makes no sense.
struct AgfCatalogue {
  std::vector<GlassPtr> glasses;
  struct Problem {
    int line;
    std::string glass; ///< "" before the first one
    std::string message;
    bool lost; ///< the glass is not among `glasses`
  };
  std::vector<Problem> problems; ///< by line
};

/// Reads a glass catalogue in the AGF format of lens-design programs: bytes or UTF-16, with or
/// without a byte order mark, lines ending in LF, CR LF or CR. Lines used: NM (name, formula, nd,
/// Vd, status), CD (coefficients), LD (range, um), IT (wavelength um, internal transmittance,
/// thickness mm). Other lines (CC, GC, ED, TD, OD, MD, BD ..) do not bear on index or absorption at
/// the reference temperature and are skipped. Formulas 1-13, mapped to GlassFormula: 1 Schott, 2
/// Sellmeier 1, 3 Herzberger, 4 Sellmeier 2, 5 Conrady, 6 Sellmeier 3, 7 Handbook 1, 8 Handbook 2,
/// 9 Sellmeier 4, 10 Extended, 11 Sellmeier 5, 12 Extended 2, 13 Extended 3. Missing
/// transmittances ("-", nothing, or 0 of 0 mm) drop their row.
///
/// A line that makes no sense is a problem and goes: without an LD or IT line its glass is as one
/// that never had it, without name, formula or coefficients it is lost. So is a glass that
/// GlassBuilder refuses; what GlassBuilder doubts is a problem too.
/// @param maker stands before the names of the glasses; may be empty
AgfCatalogue read_agf(std::string_view text, std::string_view maker);

} // namespace abbe::optics
