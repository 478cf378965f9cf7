// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"
#include "optics/interpolate.hpp"

#include <vector>

namespace abbe::lang {

/// Rows `[x, y]` up to the end of the block.
inline std::vector<optics::Pair> read_pairs(Reader& in, std::string_view x, std::string_view y) {
  std::vector<optics::Pair> rows;
  while (!in.at_end()) {
    if (!in.open_bracket()) {
      reject(in, "a row [x, y]");
      continue;
    }
    double const first = in.number(x);
    rows.push_back({first, in.number(y)});
    in.close();
  }
  return rows;
}

} // namespace abbe::lang
