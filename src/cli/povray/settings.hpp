// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::cli {

/// The wishes that POV-Ray's options tell; the values here are POV-Ray's defaults.
struct PovraySettings {
  std::string input;
  std::string output;  ///< empty: the input's name in the working directory; "-": standard output
  bool to_file = true; ///< -F: no picture is kept
  char type = 'N';     ///< of POV-Ray's letters, one of B C E H J N P T
  int bits = 8;        ///< a channel
  bool alpha = false;
  double file_gamma = 0; ///< 0: the sRGB transfer function
  std::optional<int> compression;
  int width = 160, height = 120;
  /// Counted from 1, both included; below 1 a share of the picture; 0: not given.
  double start_column = 0, end_column = 0, start_row = 0, end_row = 0;
  bool antialias = false;
  int sampling_method = 1;
  double antialias_threshold = 0.3;
  int antialias_depth = 3;
  bool jitter = true;
  double jitter_amount = 1;
  int quality = 9;
  int threads = 0; ///< 0: one a core
  bool continue_trace = false;
  bool verbose = true;
  bool messages = true; ///< the texts of #debug, #render and #statistics
  std::vector<std::string> library_paths;
  std::vector<std::string> declarations; ///< NAME=VALUE
  std::string header;                    ///< a file that is included before the scene; empty: none
  std::optional<double> version;         ///< of the language, until the scene says another
  std::optional<double> clock;
  std::optional<int> initial_frame, final_frame;
  double initial_clock = 0, final_clock = 1;
  double subset_start = 0, subset_end = 0; ///< as start_column, of the frames
  bool cyclic = false;
  std::vector<std::string> remarks; ///< about what was asked for and has no effect here
};

/// An option by its name in an ini file.
struct PovrayKey {
  std::string_view name;
  /// @return what is wrong with the text, empty: nothing
  std::function<std::string(PovraySettings&, std::string const& text)> set;
};

/// All of them, ordered by name.
std::span<PovrayKey const> povray_keys();
/// In any case of letters; null: there is none.
PovrayKey const* find_povray_key(std::string_view name);

/// Letters behind a + or -. The sign sets the first name on or off; what follows the letters is the
/// value of the second. Either may be empty.
struct PovraySwitch {
  std::string_view letters;
  std::string_view on_off, value;
};
std::span<PovraySwitch const> povray_switches();

/// Equal but for the case of letters?
bool same_word(std::string_view a, std::string_view b);

} // namespace abbe::cli
