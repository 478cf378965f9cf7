// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

/// Where include files and catalogues are on this machine.
namespace abbe::lang {

/// abbe's own: $ABBE_STDLIB, else the nearest `share/abbe/stdlib` in a folder that holds the
/// program (or the library) that this code is part of: of an installation, or of a build.
/// @return empty: there is none
std::filesystem::path stdlib_dir();

/// The include files that came with POV-Ray: $ABBE_POVRAY_INCLUDE, else those of the newest POV-Ray
/// that is installed. Empty: there are none.
std::filesystem::path povray_dir();

} // namespace abbe::lang
