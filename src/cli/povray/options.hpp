// SPDX-License-Identifier: MIT
#pragma once

#include "cli/povray/settings.hpp"

#include <filesystem>
#include <optional>

namespace abbe::cli {

/// Reads POV-Ray's options: words of a command line and ini files, the later before the earlier.
class PovrayOptions {
public:
  /// The ini file that POV-Ray reads before the command line: $POVINI, else ./povray.ini, else
  /// ~/.povray/3.7/povray.ini, else /etc/povray/3.7/povray.ini; none is no error.
  /// @return what is wrong, empty: nothing
  std::string read_defaults();
  /// "+W320", "-D", "Width=320", "name.ini[Section]", "scene.pov".
  std::string read_word(std::string const& word);
  /// @param section in any case of letters; empty: what stands before the first one
  std::string read_ini(std::filesystem::path const& path, std::string const& section);

  PovraySettings settings;

private:
  std::string set(std::string_view name, std::string const& text);
  std::string read_switch(std::string const& word);
  std::string read_file_word(std::string const& word);
  std::string read_line(std::string line);
  int depth_ = 0; ///< ini files that name ini files
};

} // namespace abbe::cli
