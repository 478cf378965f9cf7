// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

/// Files that are written beside the file that they will replace.
namespace abbe {

/// A file that nobody had before, open for reading and writing: its name cannot be foretold, and no
/// link is followed. It is locked as long as it is open: what a killed process left of the same
/// target is not, and is removed.
struct NewFile {
  int descriptor = -1; ///< -1: errno says why there is none
  std::filesystem::path path;
};
NewFile make_file_beside(std::filesystem::path const& target);

/// Gives an open file the mode and, where that is allowed, the owner of the file that it replaces,
/// if there is one.
void take_over_rights(int descriptor, std::filesystem::path const& replaced);

} // namespace abbe
