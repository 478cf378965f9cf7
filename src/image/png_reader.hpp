// SPDX-License-Identifier: MIT
#pragma once

#include "image/png_guard.hpp"

#include <cstdint>
#include <cstring>

namespace abbe::image {

/// A PNG file while libpng reads it.
class PngReader {
public:
  PngReader()
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &errors_, PngErrors::on_error,
                                    PngErrors::on_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) errors_.message = "no memory to read it";
  }
  PngReader(PngReader const&) = delete;
  PngReader& operator=(PngReader const&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }
  /// The latest error, in libpng's words.
  std::string const& message() const { return errors_.message; }
  /// png_guarded() with this reader; false without a reader too, for want of memory.
  template <class Work>
  bool guarded(Work const& work) const {
    return info_ && png_guarded(png_, work);
  }
  /// Pixels that a file of `size` bytes can hold: deflate at its best makes 1032 bytes of one.
  /// @pre the header has been read
  double most_pixels(std::uint64_t size) const {
    double const bits = png_get_bit_depth(png_, info_) * png_get_channels(png_, info_);
    return (static_cast<double>(size) * 1032 + 64) * 8 / bits;
  }

private:
  PngErrors errors_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

/// Does every chunk lie within the file? libpng allocates what a chunk claims before it reads, and
/// its own limit is a warning.
/// @param take puts the 8 bytes at a place into its second argument; false: it cannot
template <class Take>
bool png_chunks_fit(std::uint64_t size, Take const& take) {
  for (std::uint64_t at = 8; at + 8 <= size;) {
    png_byte head[8];
    if (!take(at, head)) return false;
    std::uint64_t const length = png_get_uint_32(head);
    if (std::memcmp(head + 4, "IEND", 4) == 0) break;
    if (length + 12 > size - at) return false;
    at += length + 12;
  }
  return true;
}

} // namespace abbe::image
