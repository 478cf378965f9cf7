// SPDX-License-Identifier: MIT
#include "study/settings.hpp"

#include <algorithm>
#include <array>

namespace abbe::study {
namespace {

// name, label, parameter, values (empty: --bands), words, stochastic, for lines
constexpr std::array table{
    Family{"none", "no dispersion", "bands", "", "--dispersion none --bands {}"},
    Family{"deterministic", "one ray at the middle of each band", "bands", "",
           "--dispersion deterministic --representation bands --bands {}"},
    Family{"stochastic", "one jittered ray a band, never split again", "bands", "",
           "--dispersion stochastic --bands {}", true},
    Family{"faithful", "jitter over two bands, fan-out 2 (as published)", "bands", "",
           "--dispersion faithful --bands {}", true},
    Family{"adaptive", "bands go together while they land within T pixels; 32 bands", "pixels",
           "4 0.25", "--dispersion 'adaptive tolerance {}' --bands 32"},
    Family{"rays", "stochastic, M rays a split; 16 bands", "rays", "1 2 4 8",
           "--dispersion 'stochastic rays {}' --bands 16", true},
    Family{"clusters", "one of a cluster of N wavelengths goes on (degrade); 4 bands",
           "wavelengths", "2 4 8", "--dispersion 'clusters {} degrade' --bands 4", true},
    Family{"hero", "one of N wavelengths goes on, all alike; 4 bands", "wavelengths", "2 4 8",
           "--dispersion 'hero {}' --bands 4", true},
    Family{"uniform", "stochastic, an offset drawn for each sample by itself", "bands", "4 16",
           "--dispersion 'stochastic jitter uniform' --bands {}", true},
    Family{"stratified", "stochastic, an offset for each band", "bands", "4 16",
           "--dispersion 'stochastic jitter stratified' --bands {}", true},
    Family{"triangular", "stochastic, drawn from the bands' hat functions", "bands", "4 16",
           "--dispersion 'stochastic jitter triangular 2' --bands {}", true},
    Family{"blue_noise", "stochastic, neighbouring pixels far apart", "bands", "4 16",
           "--dispersion 'stochastic jitter blue_noise' --bands {}", true},
    Family{"hall", "deterministic, bands spaced after Hall", "bands", "",
           "--dispersion deterministic --representation bands --spacing hall --bands {}"},
    Family{"composite", "deterministic, emission lines apart from the bands", "bands", "",
           "--dispersion deterministic --representation composite --bands {}", false, true},
    Family{"basis", "deterministic, K wavelengths fitted to the scene's colours", "size",
           "4 8 16 32", "--dispersion deterministic --representation 'basis {}'"},
    Family{"subdivided", "deterministic, bands halved until colours are within T", "CIEDE2000",
           "4 1 0.25", "--dispersion deterministic --representation 'adaptive tolerance {}'"},
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
