// SPDX-License-Identifier: MIT
#pragma once

#include "lang/evaluate.hpp"
#include "render/render.hpp"

#include <cstdint>
#include <string>

namespace abbe::cli {

/// A hash of everything that the pixels of a picture depend on: the texts of the scene, what it
/// asked the clock and other files for (the evaluated scene, where it can have), the options, the
/// program.
/// @param words the rest of the command line that matters
std::uint64_t picture_identity(lang::Evaluated const& evaluated,
                               render::RenderOptions const& options, std::string const& words);

} // namespace abbe::cli
