// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"

#include <string_view>
#include <vector>

namespace abbe::optics {

/// Reads a glass catalogue in the AGF format of lens-design programs (text, or UTF-16 with a byte
/// order mark). Lines used: NM (name, formula, nd, Vd, status), CD (coefficients), LD (range, um),
/// IT (wavelength um, internal transmittance, thickness mm). Other lines (CC, GC, ED, TD, OD, MD,
/// BD ..) do not bear on index or absorption at the reference temperature and are skipped. Formulas
/// 1-13, mapped to GlassFormula: 1 Schott, 2 Sellmeier 1, 3 Herzberger, 4 Sellmeier 2, 5 Conrady, 6
/// Sellmeier 3, 7 Handbook 1, 8 Handbook 2, 9 Sellmeier 4, 10 Extended, 11 Sellmeier 5, 12 Extended
/// 2, 13 Extended 3. Missing transmittances ("-" or nothing) drop their row; IT rows of different
/// thickness are brought to 1 mm.
/// @param maker stands before the names of the glasses; may be empty
/// @error E0414 "line 12: ..": malformed number, unknown formula, glass without coefficients, and
/// whatever
///        GlassBuilder finds wrong with a glass
Result<std::vector<GlassPtr>> read_agf(std::string_view text, std::string_view maker);

} // namespace abbe::optics
