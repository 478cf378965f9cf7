// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace abbe {

/// FNV-1a over words of 8 bytes: tells texts and torn writes apart, and is no secret.
class WordHash {
public:
  void add(void const* bytes, std::size_t count) {
    auto const* at = static_cast<char const*>(bytes);
    while (count > 0) {
      std::uint64_t word = 0;
      std::size_t const part = std::min(count, sizeof word);
      std::memcpy(&word, at, part);
      add(word);
      at += part;
      count -= part;
    }
  }
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3;
    value_ ^= value_ >> 29;
  }
  /// With its length: "ab", "c" is not "a", "bc".
  void add_text(std::string_view text) {
    add(text.size());
    add(text.data(), text.size());
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

} // namespace abbe
