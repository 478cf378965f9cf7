// SPDX-License-Identifier: MIT
#pragma once

#include "scene/dispersion_mode.hpp"

#include <span>
#include <string>

namespace abbe::study {

/// A way in which a picture may be made: a mode of dispersion with a parameter that is made finer
/// step by step, beside the number of bands.
struct Way {
  char const* name;
  scene::DispersionMode (*mode)(double parameter); ///< nullptr: as the scene has it
  std::span<double const> steps;                   ///< parameters, from the cheapest on
  int first_bands; ///< below this the mode is not looked at; it may have more
};

/// All modes that may win, in the order in which they are looked at.
std::span<Way const> ways();
/// For scenes without dispersion, and where the mode is given.
Way const& way_of_the_scene();

} // namespace abbe::study
