// SPDX-License-Identifier: MIT
#pragma once

#include "optics/conductor.hpp"
#include "optics/data_library.hpp"
#include "optics/spectrum.hpp"

namespace abbe::optics {

/// Entries of stdlib/spectra as objects. `library` is DataLibrary::open(stdlib / "spectra").
/// @error E0413 unknown or ambiguous name, or an entry of another kind; E0417, E0501 damaged data

/// CIE illuminants ("D65", "F11", "HP1", "LED-B3") and lamps ("LPS", "sodium", "Metal Halide").
Result<Spectrum> load_light(DataLibrary const& library, std::string_view name);
/// Reflectances: "macbeth/dark skin" or "dark skin".
Result<Spectrum> load_reflectance(DataLibrary const& library, std::string_view name);
/// Metals: "Au" is the default dataset, "Au/McPeak_2015" a particular one.
Result<Conductor> load_metal(DataLibrary const& library, std::string_view name);

} // namespace abbe::optics
