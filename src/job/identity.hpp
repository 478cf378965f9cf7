// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <cstdint>

namespace abbe::job {

/// A hash of everything that the pixels of a picture depend on: the scene, the options (but for
/// the number of threads, which makes no difference) and the program, whose file is read.
/// @param scene that of the scene and of how it is planned
std::uint64_t picture_identity(std::uint64_t scene, render::RenderOptions const& options);

} // namespace abbe::job
