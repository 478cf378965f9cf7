// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace abbe::image {

/// Bytes one after another; past the end there are zeros, and it is noted.
class Bytes {
public:
  explicit Bytes(std::string_view bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {}
  unsigned next() {
    if (at_ < bytes_.size()) return static_cast<unsigned char>(bytes_[at_++]);
    short_ = true;
    return 0;
  }
  unsigned little16() {
    unsigned const low = next();
    return low | next() << 8;
  }
  std::uint32_t little32() {
    unsigned const low = little16();
    return low | little16() << 16;
  }
  void skip(std::size_t count) {
    short_ = short_ || count > bytes_.size() - at_;
    at_ = std::min(bytes_.size(), at_ + count);
  }
  void go_to(std::size_t at) {
    short_ = short_ || at > bytes_.size();
    at_ = std::min(bytes_.size(), at);
  }
  /// A number in letters, behind blanks and comments.
  std::int64_t decimal() {
    unsigned c = next();
    while (!short_ && (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '#')) {
      if (c == '#')
        while (!short_ && c != '\n') c = next();
      c = next();
    }
    std::int64_t value = 0;
    if (c < '0' || c > '9') short_ = true;
    for (; c >= '0' && c <= '9' && value < 1000000000; c = next()) value = value * 10 + (c - '0');
    return value;
  }
  /// Up to the end of the line, which is taken too.
  std::string line() {
    std::string out;
    for (unsigned c = next(); !short_ && c != '\n'; c = next()) out += static_cast<char>(c);
    return out;
  }
  bool too_short() const { return short_; }
  std::size_t left() const { return bytes_.size() - at_; }

private:
  std::string_view bytes_;
  std::size_t at_;
  bool short_ = false;
};

} // namespace abbe::image
