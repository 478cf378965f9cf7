// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::study {

/// A way to render that has one parameter to turn: a row of settings_table.cpp.
struct Family {
  std::string_view name;      ///< for --modes: "deterministic"
  std::string_view label;     ///< what it is, for people
  std::string_view parameter; ///< what the number means: "bands"
  std::string_view values;    ///< "1 2 4"; empty: those of --bands
  /// Words of the command line of `abbe render`, apart by blanks, '...' around a word with blanks;
  /// {} is the value.
  std::string_view words;
  bool stochastic = false; ///< seeds make different pictures
  /// Channels for lines are all that it has beyond `deterministic`.
  bool for_lines = false;
};

std::span<Family const> families();
/// @return null when there is none
Family const* find_family(std::string_view name);

/// Anti-aliasing of the command line: "off", a depth, depth/threshold ("3", "4/0"), or samples of a
/// pixel ("s16", "s1..64", "s1..64/0.02": with an error).
struct Sampling {
  std::string text;
  std::vector<std::string> words() const;
  int samples() const;         ///< of a pixel, at most
  Sampling everywhere() const; ///< as deep, in each pixel
};
/// @error E0530
Result<Sampling> parse_sampling(std::string const& text);

/// One point of the study.
struct Setting {
  Family const* family = nullptr;
  double value = 0;
  std::string name; ///< "deterministic 8", "deterministic 8, aa 3": unique in a study
  std::string aa;
  std::vector<std::string> words; ///< of the command line
};

struct Selection {
  std::vector<std::string> modes; ///< names of families; empty: all
  std::vector<int> bands;         ///< ascending
  std::vector<std::string> aa;    ///< at least one
};
/// Every family at each of its values, for each anti-aliasing.
/// @error E0530 unknown mode, with the known ones; anti-aliasing that cannot be
Result<std::vector<Setting>> make_settings(Selection const& selection);

/// The words of a row with {} replaced.
std::vector<std::string> fill_words(std::string_view words, std::string_view value);

} // namespace abbe::study
