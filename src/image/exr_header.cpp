// SPDX-License-Identifier: MIT
#include "image/exr_header.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <utility>

static_assert(std::endian::native == std::endian::little, "OpenEXR headers are little-endian");

namespace abbe::image {
namespace {

/// Bytes of the header in order. After an attempt to read past the end `ok` is false for good.
struct Cursor {
  std::FILE* file;
  std::int64_t size; ///< of the file
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
  std::int64_t at() const { return ::ftello(file); }
  void go_to(std::int64_t place) {
    if (place > size || ::fseeko(file, static_cast<off_t>(place), SEEK_SET) != 0) ok = false;
  }
};

/// What decides how large the image can be.
struct Claims {
  std::array<std::int32_t, 4> window{0, 0, -1, -1};
  double bytes_per_pixel = 0;
  int compression = 0;
  double tile_pixels = 0;
};

/// OpenEXR makes room for a whole tile even where the picture is smaller: of 2048 x 2048 at most,
/// unless the length of the file can account for more.
constexpr double largest_tile = 2048.0 * 2048.0;

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

/// Types whose values OpenEXR reads without a look at the size that stands before them.
std::int64_t fixed_size(std::string_view type) {
  constexpr std::pair<std::string_view, std::int64_t> sizes[] = {
      {"box2i", 16},      {"box2f", 16},    {"chromaticities", 32},
      {"compression", 1}, {"double", 8},    {"envmap", 1},
      {"float", 4},       {"int", 4},       {"keycode", 28},
      {"m33f", 36},       {"m33d", 72},     {"m44f", 64},
      {"m44d", 128},      {"v2i", 8},       {"v2f", 8},
      {"v2d", 16},        {"v3i", 12},      {"v3f", 12},
      {"v3d", 24},        {"lineOrder", 1}, {"deepImageState", 1},
      {"rational", 8},    {"tiledesc", 9},  {"timecode", 8}};
  for (auto const& [name, size] : sizes)
    if (name == type) return size;
  return -1;
}

/// Does the value of an attribute end where its size says, and need no more memory than the file
/// can account for? Else OpenEXR would read what follows as something else, or allocate gigabytes.
void check_value(Cursor& in, std::string_view type, std::int64_t size) {
  std::int64_t const end = in.at() + size;
  std::int64_t const fixed = fixed_size(type);
  if (size < 0 || end > in.size || (fixed >= 0 && fixed != size)) {
    in.ok = false;
  } else if (type == "stringvector") {
    while (in.ok && in.at() < end) {
      auto const length = in.value<std::int32_t>();
      if (length < 0 || in.at() + length > end)
        in.ok = false;
      else
        in.go_to(in.at() + length);
    }
  } else if (type == "preview") {
    auto const width = in.value<std::uint32_t>(), height = in.value<std::uint32_t>();
    if (8 + 4.0 * width * height != static_cast<double>(size)) in.ok = false;
  } else if (type == "idmanifest") {
    // Deflated; the number is its size when inflated.
    if (in.value<std::uint32_t>() > 1032.0 * static_cast<double>(size)) in.ok = false;
  }
}

void read_attributes(Cursor& in, Claims& claims) {
  while (in.ok) {
    std::string const name = in.text();
    if (name.empty()) return;
    std::string const type = in.text();
    auto const size = in.value<std::int32_t>();
    std::int64_t const start = in.at();
    check_value(in, type, size);
    if (!in.ok) return;
    in.go_to(start);
    if (name == "dataWindow" && type == "box2i")
      claims.window = in.value<decltype(claims.window)>();
    if (name == "tiles" && type == "tiledesc") {
      auto const width = in.value<std::uint32_t>(), height = in.value<std::uint32_t>();
      claims.tile_pixels = static_cast<double>(width) * height;
    }
    if (name == "compression") claims.compression = in.value<std::uint8_t>();
    if (type == "chlist") {
      Claims other;
      read_channels(in, name == "channels" ? claims : other);
      if (in.at() != start + size) in.ok = false;
    }
    in.go_to(start + size);
  }
}

} // namespace

Status check_exr_header(std::filesystem::path const& path, InputFile const& file) {
  std::rewind(file.stream.get());
  Cursor in{file.stream.get(), static_cast<std::int64_t>(file.size)};
  auto const magic = in.value<std::uint32_t>();
  auto const version = in.value<std::uint32_t>();
  if (!in.ok || magic != 20000630) return damaged(path, "it does not begin like an OpenEXR file");
  if (version & 0x800) return unsupported(path, "it holds deep data");
  // One header; of a file of several parts one each, and an empty one at the end.
  bool const parts = (version & 0x1000) != 0;
  for (bool first = true;; first = false) {
    Claims claims;
    std::int64_t const start = in.at();
    read_attributes(in, claims);
    if (!in.ok) return damaged(path, "its header is broken off or makes no sense");
    if (!first && in.at() == start + 1) return std::monostate{};
    if (claims.compression >= static_cast<int>(best_ratio.size()))
      return unsupported(path,
                         fmt::format("its compression has the number {}", claims.compression));
    auto const [x0, y0, x1, y1] = claims.window;
    double const most = static_cast<double>(file.size)
                        * best_ratio[static_cast<std::size_t>(claims.compression)]
                        / claims.bytes_per_pixel;
    if (claims.tile_pixels > std::max(most, largest_tile))
      return damaged(path, "its tiles are larger than the file can account for");
    Status const fits =
        check_size(path, std::int64_t{x1} - x0 + 1, std::int64_t{y1} - y0 + 1, most);
    if (!fits || !parts) return fits;
  }
}

} // namespace abbe::image
