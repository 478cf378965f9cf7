// SPDX-License-Identifier: MIT
#pragma once

#include "lang/evaluate.hpp"

#include <cstdint>
#include <string>

namespace abbe::cli {

/// A hash of everything that a scene depends on: its texts, and what it asked the clock and other
/// files for (the evaluated scene, where it can have).
/// @param words the rest of the command line that matters
std::uint64_t scene_identity(lang::Evaluated const& evaluated, std::string const& words);

} // namespace abbe::cli
