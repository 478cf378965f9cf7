// SPDX-License-Identifier: MIT
#pragma once

#include "base/file_text.hpp"
#include "base/result.hpp"

#include <string>

namespace abbe {

/// A file that was read, and where it lies: links resolved as they led when it was opened, not
/// before or after.
struct ReadFile {
  FileText text;
  std::string place;
};

/// Reads a regular file.
/// @error E0501 the system's reason alone: "No such file or directory"
Result<ReadFile> read_file(std::string const& path);

} // namespace abbe
