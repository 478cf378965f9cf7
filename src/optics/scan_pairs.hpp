// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace abbe::optics {

/// Reads the rows `[a, b]` (or `[a, b, c]`) of a data entry such as
/// `illuminant_entry "D65" { [300, 0.0341] [305, 1.66] }`: everything up to the first `{` is
/// skipped, quotes respected; then only rows, separated by blanks or commas, up to `}` or the end
/// of the text. A text that begins with `[` has no braces. Numbers only: expressions are the
/// language's business.
/// @error E0417 says at which byte a row is malformed
/// Instantiated for N = 2 and 3.
template <std::size_t N>
Result<std::vector<std::array<double, N>>> scan_rows(std::string_view text);

inline Result<std::vector<std::array<double, 2>>> scan_pairs(std::string_view text) {
  return scan_rows<2>(text);
}

} // namespace abbe::optics
