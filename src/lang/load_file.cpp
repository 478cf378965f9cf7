// SPDX-License-Identifier: MIT
#include "lang/load_file.hpp"

#include <algorithm>
#include <cctype>

namespace abbe::lang {
namespace {

bool is_missing(Result<std::string> const& file) {
  return !file && file.error().message.starts_with("cannot find");
}

} // namespace

Result<std::string> load_file(Interpreter& in, std::string_view path_as_written,
                              std::initializer_list<std::string_view> extensions) {
  auto file = load_file(in, path_as_written);
  if (!is_missing(file)) return file;
  for (std::string_view const extension : extensions) {
    std::string capitals(extension);
    std::ranges::transform(capitals, capitals.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    for (std::string const& end : {std::string(extension), capitals}) {
      auto other = load_file(in, std::string(path_as_written) + end);
      if (!is_missing(other)) return other;
    }
  }
  return file;
}

Result<std::string> load_picture(Interpreter& in, std::string_view path_as_written,
                                 std::string_view kind) {
  if (kind == "jpeg") return load_file(in, path_as_written, {".jpg", ".jpeg"});
  if (kind == "tiff") return load_file(in, path_as_written, {".tif", ".tiff"});
  if (kind == "sys") return load_file(in, path_as_written, {".bmp"});
  if (!kind.empty()) {
    std::string const extension = "." + std::string(kind);
    return load_file(in, path_as_written, {extension});
  }
  return load_file(in, path_as_written,
                   {".png", ".gif", ".tga", ".jpg", ".jpeg", ".tif", ".tiff", ".ppm", ".pgm",
                    ".bmp", ".hdr", ".exr"});
}

} // namespace abbe::lang
