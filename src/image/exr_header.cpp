// SPDX-License-Identifier: MIT
#include "image/exr_header.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

static_assert(std::endian::native == std::endian::little, "OpenEXR headers are little-endian");

namespace abbe::image {
namespace {

/// Bytes of the header in order. After an attempt to read past the end `ok` is false for good.
struct Cursor {
  std::FILE* file;
  bool ok = true;

  void bytes(void* to, std::size_t count) {
    if (ok && std::fread(to, 1, count, file) != count) ok = false;
    if (!ok) std::memset(to, 0, count);
  }
  template <class T>
  T value() {
    T result{};
    bytes(&result, sizeof result);
    return result;
  }
  std::string text() {
    std::string result;
    for (char c = value<char>(); ok && c != 0; c = value<char>()) {
      result += c;
      if (result.size() > 255) ok = false;
    }
    return result;
  }
  void skip(std::int64_t count) {
    if (::fseeko(file, static_cast<off_t>(count), SEEK_CUR) != 0) ok = false;
  }
};

/// What decides how large the image can be.
struct Claims {
  std::array<std::int32_t, 4> window{0, 0, -1, -1};
  double bytes_per_pixel = 0;
  int compression = 0;
};

/// What follows the name of a channel.
struct ChannelEntry {
  std::int32_t type, linear, x_step, y_step;
};

/// Bytes that one byte of the file can stand for. Deflate: 1032 (RFC 1951: 258 bytes in 2 bits).
/// RLE: 127 in 2 bytes. PIZ: runs of 255 values of 2 bytes in some 10 bits. PXR24: deflate of 3
/// bytes of 4. B44 and B44A: 32 bytes in 14 and in 3. DWA: 64 coefficients for each one deflated.
constexpr std::array<double, 10> best_ratio{1, 64, 1032, 1032, 4096, 1376, 2.3, 10.7, 66048, 66048};

void read_channels(Cursor& in, Claims& claims) {
  while (in.ok) {
    if (in.text().empty()) return;
    auto const channel = in.value<ChannelEntry>();
    if (channel.x_step < 1 || channel.y_step < 1 || channel.type < 0 || channel.type > 2) {
      in.ok = false;
      return;
    }
    double const size = channel.type == 1 ? 2 : 4;
    claims.bytes_per_pixel += size / channel.x_step / channel.y_step;
  }
}

void read_attributes(Cursor& in, Claims& claims) {
  while (in.ok) {
    std::string const name = in.text();
    if (name.empty()) return;
    std::string const type = in.text();
    auto const size = in.value<std::int32_t>();
    if (size < 0) in.ok = false;
    off_t const start = ::ftello(in.file);
    if (name == "dataWindow" && type == "box2i")
      claims.window = in.value<decltype(claims.window)>();
    if (name == "compression") claims.compression = in.value<std::uint8_t>();
    if (name == "channels") read_channels(in, claims);
    if (in.ok && ::fseeko(in.file, start + size, SEEK_SET) != 0) in.ok = false;
  }
}

} // namespace

Status check_exr_header(std::filesystem::path const& path, InputFile const& file) {
  std::rewind(file.stream.get());
  Cursor in{file.stream.get()};
  auto const magic = in.value<std::uint32_t>();
  auto const version = in.value<std::uint32_t>();
  if (!in.ok || magic != 20000630) return damaged(path, "it does not begin like an OpenEXR file");
  if (version & 0x800) return unsupported(path, "it holds deep data");
  Claims claims;
  read_attributes(in, claims);
  if (!in.ok) return damaged(path, "its header is broken off or makes no sense");
  if (claims.compression >= static_cast<int>(best_ratio.size()))
    return unsupported(path, fmt::format("its compression has the number {}", claims.compression));
  auto const [x0, y0, x1, y1] = claims.window;
  double const most = static_cast<double>(file.size)
                      * best_ratio[static_cast<std::size_t>(claims.compression)]
                      / claims.bytes_per_pixel;
  return check_size(path, std::int64_t{x1} - x0 + 1, std::int64_t{y1} - y0 + 1, most);
}

} // namespace abbe::image
