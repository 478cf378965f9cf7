// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "optics/glass.hpp"

#include <string>

namespace abbe::cli {

/// A catalogue glass as a scene gets it: the catalogue is written in the scene language.
/// @error E0413 there is none of this name; what the scene language says otherwise
Result<optics::GlassPtr> glass_of_name(std::string const& name);

} // namespace abbe::cli
