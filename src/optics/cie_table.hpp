// SPDX-License-Identifier: MIT
#pragma once

#include <array>

/// The two tables of the CIE that every spectral calculation needs, compiled in.
/// @source CIE 15 / ISO-CIE 11664-1 (1931 standard observer), ISO-CIE 11664-2 (illuminant D65)
namespace abbe::optics {

inline constexpr int cie_first_nm = 360;
inline constexpr int cie_last_nm = 830;
inline constexpr int cie_count = cie_last_nm - cie_first_nm + 1;

/// xbar, ybar, zbar at 360, 361 .. 830 nm.
extern std::array<std::array<double, 3>, cie_count> const cie_1931_observer;

inline constexpr int d65_step_nm = 5;
inline constexpr int d65_count = (cie_last_nm - cie_first_nm) / d65_step_nm + 1;
/// Relative power of D65 at 360, 365 .. 830 nm, 100 at 560 nm; linear in between, as the CIE asks.
extern std::array<double, d65_count> const cie_d65;

} // namespace abbe::optics
