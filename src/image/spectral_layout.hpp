// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Names of the spectral channels of OpenEXR files.
/// @source Fichet, Pacanowski, Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10(3), 2021
namespace abbe::image {

/// "S0.550,5nm": unpolarised emission (Stokes component 0) at a wavelength, with a decimal comma.
/// Shortest form that gives the same double when read. @pre positive and finite
std::string spectral_channel_name(double wavelength_nm);

/// The wavelength in nm of an emissive channel of Stokes component 0; nothing for other names.
/// Takes what the layout allows: exponents, any SI prefix, m or Hz ("S0.5,45e+2nm", "S0.550THz").
std::optional<double> parse_spectral_channel(std::string_view name);

/// Numbers in shortest exact decimal form, separated by blanks.
std::string join_numbers(std::vector<double> const& values);
/// Its inverse; nothing when the text is anything else.
std::optional<std::vector<double>> split_numbers(std::string_view text);

inline constexpr char layout_version_attribute[] = "spectralLayoutVersion";
inline constexpr char emissive_units_attribute[] = "emissiveUnits";
inline constexpr char band_edges_attribute[] = "abbeBandEdges";

} // namespace abbe::image
