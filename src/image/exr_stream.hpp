// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <ImfIO.h>
#include <filesystem>

namespace abbe::image {

/// Reads a picture whose header check_exr_header() has found sound. @param path for messages
/// @error E0513, E0516
Result<Image> read_exr_stream(Imf::IStream& stream, std::filesystem::path const& path);

} // namespace abbe::image
