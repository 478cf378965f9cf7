// SPDX-License-Identifier: MIT
// Any bytes as a picture: PNG, OpenEXR, TIFF. A picture that was accepted must fit together.
#include "image/io.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

std::uint32_t big_endian(std::uint8_t const* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8
         | std::uint32_t{at[3]};
}

/// Without right checksums every mutated PNG would end at its first chunk.
void mend_checksums(std::uint8_t* data, std::size_t size) {
  if (size < 8 || std::memcmp(data, "\x89PNG\r\n\x1a\n", 8) != 0) return;
  for (std::size_t at = 8; size - at >= 12;) {
    std::size_t const length = big_endian(data + at);
    if (length > size - at - 12) return;
    auto const sum = crc32(crc32(0, nullptr, 0), data + at + 4, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i)
      data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += length + 12;
  }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  std::size_t const changed = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 != 0) mend_checksums(data, changed);
  return changed;
}

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
