// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <zlib.h>

/// Mutates pictures: PNG keeps right checksums as a rule. One source of a fuzzer includes it.

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
