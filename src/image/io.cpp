// SPDX-License-Identifier: MIT
#include "image/io.hpp"

#include "image/atomic_file.hpp"
#include "image/input_file.hpp"
#include "image/writer.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

namespace abbe::image {
namespace {

enum class Format { Exr, Png, Tiff, Ppm, Tga, Bmp, Jpeg, Hdr };

constexpr std::pair<std::string_view, Format> extensions[] = {
    {".exr", Format::Exr},   {".png", Format::Png}, {".tif", Format::Tiff}, {".tiff", Format::Tiff},
    {".ppm", Format::Ppm},   {".tga", Format::Tga}, {".bmp", Format::Bmp},  {".jpg", Format::Jpeg},
    {".jpeg", Format::Jpeg}, {".hdr", Format::Hdr}};

Result<Format> format_by_extension(std::filesystem::path const& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (auto const& [name, format] : extensions)
    if (extension == name) return format;
  return Error{"E0512", fmt::format("cannot write '{}': {}; images are written as .exr or .hdr "
                                    "(linear), .tif (LogLuv), .png, .ppm, .tga, .bmp or .jpg "
                                    "(sRGB)",
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

ImageHead head_of(Image const& image) {
  return {image.width,
          image.height,
          !image.alpha.empty(),
          image.band_centres_nm,
          image.band_edges_nm,
          image.metadata,
          {}};
}

Result<std::unique_ptr<ImageWriter>> open_writer(ImageHead head, std::filesystem::path const& path,
                                                 WriteOptions const& options) {
  Result<Format> const format = format_by_extension(path);
  if (!format) return format.error();
  switch (*format) {
  case Format::Exr:
    return open_exr(std::move(head), path, options.exr);
  case Format::Png:
    return open_png(std::move(head), path, options.display);
  case Format::Ppm:
    return open_ppm(std::move(head), path, options.display);
  case Format::Tga:
    return open_tga(std::move(head), path, options.display);
  case Format::Bmp:
    return open_bmp(std::move(head), path, options.display);
  case Format::Jpeg:
    return open_jpeg(std::move(head), path, options.display);
  case Format::Hdr:
    return open_hdr(std::move(head), path);
  case Format::Tiff:
    return open_tiff_logluv(std::move(head), path);
  }
  ABBE_ASSERT(false);
}

namespace {

Status write_all(Image const& image, Result<std::unique_ptr<ImageWriter>> writer) {
  if (!writer) return writer.error();
  if (Status const written = (*writer)->write(image); !written) return written;
  return (*writer)->finish({});
}

} // namespace

Status write_exr(Image const& image, std::filesystem::path const& path, ExrOptions const& options) {
  if (Status const valid = validate(image); !valid) return valid;
  return write_all(image, open_exr(head_of(image), path, options));
}

Status write_png(Image const& image, std::filesystem::path const& path,
                 DisplayOptions const& options) {
  if (Status const valid = validate(image); !valid) return valid;
  return write_all(image, open_png(head_of(image), path, options));
}

Status write_tiff_logluv(Image const& image, std::filesystem::path const& path) {
  if (Status const valid = validate(image); !valid) return valid;
  return write_all(image, open_tiff_logluv(head_of(image), path));
}

Status write(Image const& image, std::filesystem::path const& path, WriteOptions const& options) {
  if (Status const valid = validate(image); !valid) return valid;
  return write_all(image, open_writer(head_of(image), path, options));
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
  default: // format_by_content knows no other
    break;
  }
  ABBE_ASSERT(false);
}

} // namespace abbe::image
