// SPDX-License-Identifier: MIT
#include "study/settings.hpp"

#include <algorithm>
#include <array>

namespace abbe::study {
namespace {

// name, label, parameter, values (empty: --bands), words, stochastic
constexpr std::array table{
    Family{"none", "no dispersion", "bands", "", "--dispersion none --bands {}"},
    Family{"deterministic", "one ray at the middle of each band", "bands", "",
           "--dispersion deterministic --bands {}"},
    Family{"stochastic", "one jittered ray a band, never split again", "bands", "",
           "--dispersion stochastic --bands {}", true},
    Family{"faithful", "jitter over two bands, fan-out 2 (as published)", "bands", "",
           "--dispersion faithful --bands {}", true},
};

} // namespace

std::span<Family const> families() {
  return table;
}

Family const* find_family(std::string_view name) {
  auto const* const found =
      std::find_if(table.begin(), table.end(), [&](Family const& f) { return f.name == name; });
  return found == table.end() ? nullptr : found;
}

} // namespace abbe::study
