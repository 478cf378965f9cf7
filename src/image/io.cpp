// SPDX-License-Identifier: MIT
#include "image/io.hpp"

#include "image/atomic_file.hpp"
#include "image/input_file.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace abbe::image {
namespace {

enum class Format { Exr, Png, Tiff };

Result<Format> format_by_extension(std::filesystem::path const& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (extension == ".exr") return Format::Exr;
  if (extension == ".png") return Format::Png;
  if (extension == ".tif" || extension == ".tiff") return Format::Tiff;
  return Error{"E0512", fmt::format("cannot write '{}': {}; images are written as .exr (linear), "
                                    ".png (sRGB) or .tif (LogLuv)",
                                    path.string(),
                                    extension.empty() ? "its name has no extension"
                                                      : "unknown extension '" + extension + "'")};
}

std::optional<Format> format_by_content(std::string_view head) {
  using std::string_view_literals::operator""sv;
  if (head.starts_with("\x76\x2f\x31\x01"sv)) return Format::Exr;
  if (head.starts_with("\x89PNG\r\n\x1a\n"sv)) return Format::Png;
  for (auto const magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (head.starts_with(magic)) return Format::Tiff;
  return std::nullopt;
}

} // namespace

Status write(Image const& image, std::filesystem::path const& path, WriteOptions const& options) {
  Result<Format> const format = format_by_extension(path);
  if (!format) return format.error();
  switch (*format) {
  case Format::Exr:
    return write_exr(image, path, options.exr);
  case Format::Png:
    return write_png(image, path, options.png);
  case Format::Tiff:
    return write_tiff_logluv(image, path);
  }
  ABBE_ASSERT(false);
}

Status check_destination(std::filesystem::path const& path) {
  if (Result<Format> const format = format_by_extension(path); !format) return format.error();
  if (auto const target = writable_target(path); !target) return target.error();
  return std::monostate{};
}

Result<Image> read(std::filesystem::path const& path) {
  std::array<char, 8> head{};
  {
    Result<InputFile> const file = open_input(path);
    if (!file) return file.error();
    std::size_t const count = std::fread(head.data(), 1, head.size(), file->stream.get());
    if (count == 0) return damaged(path, "it is empty");
  }
  auto const format = format_by_content({head.data(), head.size()});
  if (!format)
    return Error{"E0512", fmt::format("cannot read '{}': it is neither OpenEXR nor PNG nor TIFF",
                                      path.string())};
  switch (*format) {
  case Format::Exr:
    return read_exr(path);
  case Format::Png:
    return read_png(path);
  case Format::Tiff:
    return read_tiff(path);
  }
  ABBE_ASSERT(false);
}

} // namespace abbe::image
