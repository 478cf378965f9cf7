// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::lang {

/// The names of the include files (*.inc) in these folders that declare a name by #declare or
/// #macro, sorted. Reads them all: for messages about a name that nothing declares.
std::vector<std::string> declaring_files(std::string_view name,
                                         std::vector<std::filesystem::path> const& folders);

} // namespace abbe::lang
