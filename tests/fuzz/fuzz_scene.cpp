// SPDX-License-Identifier: MIT
// libFuzzer's entry: any bytes as a scene.
#include "evaluate_limited.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  auto const evaluated = abbe::fuzz::evaluate_limited(
      ABBE_SOURCE_DIR "/examples/fuzz.scn", std::string(reinterpret_cast<char const*>(data), size));
  std::string const wrong = abbe::fuzz::complaint(evaluated);
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "fuzz_scene: %s\n", wrong.c_str());
  std::abort();
}
