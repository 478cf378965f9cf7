// SPDX-License-Identifier: MIT
// Any bytes as a glass catalogue; a glass said to be sound over the visible range must be so at
// each wavelength.
#include "optics/agf.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  auto const read = abbe::optics::read_agf({reinterpret_cast<char const*>(data), size}, "FUZZ");
  for (auto const& glass : read.glasses) {
    if (glass->check_range(360, 830)) continue;
    for (double const lambda_nm : {360.0, 400.0, 500.0, 587.5618, 700.0, 830.0}) {
      double const index = glass->index_unchecked(lambda_nm);
      if (std::isfinite(index) && index > 0) continue;
      std::fprintf(stderr, "fuzz_agf: index %g of %s at %g nm\n", index, glass->name().c_str(),
                   lambda_nm);
      std::abort();
    }
  }
  return 0;
}
