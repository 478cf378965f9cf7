// SPDX-License-Identifier: MIT
#pragma once

#include "image/input_file.hpp"

namespace abbe::image {

/// Looks at the header of an OpenEXR file before the library does, which allocates by what the
/// header claims: the size must be positive, at most max_pixels, and such that the file can hold it
/// at the best ratio its compression reaches. Reads flat images only.
/// @error E0513, E0514; E0516 for deep data
Status check_exr_header(std::filesystem::path const& path, InputFile const& file);

} // namespace abbe::image
