// SPDX-License-Identifier: MIT
// Any bytes as a picture of a texture, whatever its kind. One that was accepted must fit together,
// and its memory must not be more than its length can account for.
#include "image/texels.hpp"
#include "tests/fuzz/png_mutator.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

[[noreturn]] void fail(char const* what) {
  std::fprintf(stderr, "fuzz_texels: %s\n", what);
  std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const bytes(reinterpret_cast<char const*>(data), size);
  auto const texels = abbe::image::read_texels(bytes, "input");
  if (!texels) {
    if (texels.error().code.size() != 5 || texels.error().message.empty())
      fail("an error without a code or a message");
    return 0;
  }
  std::size_t const pixels =
      static_cast<std::size_t>(texels->width) * static_cast<std::size_t>(texels->height);
  if (texels->width <= 0 || texels->height <= 0) fail("no size");
  if (texels->rgba.size() != 4 * pixels) fail("colours do not fit the size");
  constexpr std::size_t most_a_byte = 70000; // of a TIFF of bits, or of OpenEXR's lossy kind
  if (pixels > most_a_byte * size) fail("more pixels than the file can account for");
  if (!texels->index.empty() && texels->index.size() != pixels) fail("numbers do not fit the size");
  return 0;
}
