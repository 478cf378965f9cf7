// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace abbe::image {

/// A file open for reading, with its length.
struct InputFile {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> stream;
  std::uint64_t size = 0;
};

/// @error E0511 with the reason of the operating system; not a regular file
Result<InputFile> open_input(std::filesystem::path const& path);

/// E0513: the file is not what it claims to be.
Error damaged(std::filesystem::path const& path, std::string const& why);
/// E0516: a sound file, of a kind that is not read.
Error unsupported(std::filesystem::path const& path, std::string const& why);

/// Refuses sizes before memory is allocated for them.
/// @param most_pixels what the length of the file can account for at the best possible compression
/// @error E0513 not positive, or more than most_pixels; E0514 more than max_pixels
Status check_size(std::filesystem::path const& path, std::int64_t width, std::int64_t height,
                  double most_pixels);

} // namespace abbe::image
