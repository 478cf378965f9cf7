// SPDX-License-Identifier: MIT
#include "cli/say.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace abbe::cli {
namespace {

/// Bytes of the character that begins the text, 0 when it must not reach a terminal: a control
/// character (C0, DEL, C1), or no UTF-8.
std::size_t harmless_length(std::string_view text) {
  auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  unsigned const first = byte(0);
  if (first < 0x80) return first == '\n' || first == '\t' || (first >= 0x20 && first != 0x7f);
  std::size_t const length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  std::uint32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t least[] = {0, 0, 0xa0, 0x800, 0x10000};
  bool const surrogate = code >= 0xd800 && code < 0xe000;
  return code < least[length] || code > 0x10ffff || surrogate ? 0 : length;
}

void put(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

} // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    std::size_t const length = harmless_length(text);
    if (length > 0)
      out += text.substr(0, length);
    else
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return out;
}

void say_text(std::string_view text) {
  put(printable(text));
}

void say_progress(std::string_view line) {
  put(line);
  std::fflush(stderr);
}

} // namespace abbe::cli
