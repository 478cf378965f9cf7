// SPDX-License-Identifier: MIT
// Any bytes as a picture: PNG, OpenEXR, TIFF. A picture that was accepted must fit together.
#include "image/io.hpp"
#include "tests/fuzz/png_mutator.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  int const file = ::memfd_create("fuzz_image", 0);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  auto const image = abbe::image::read(fmt::format("/proc/self/fd/{}", file));
  ::close(file);
  if (!image) return 0;
  if (auto const sound = abbe::image::validate(*image); !sound) {
    std::fprintf(stderr, "fuzz_image: %s\n", sound.error().message.c_str());
    std::abort();
  }
  return 0;
}
