// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <string>
#include <tiffio.h>

namespace abbe::image {

/// Keeps what libtiff says for the report: the first error, and errno at that time.
struct TiffErrors {
  std::string message;
  int os_error = 0;

  static int on_error(TIFF*, void* self, char const*, char const* format, va_list arguments) {
    auto* errors = static_cast<TiffErrors*>(self);
    if (!errors->message.empty()) return 1;
    int const os_error = errno;
    char text[500];
    std::vsnprintf(text, sizeof text, format, arguments);
    errors->message = text;
    errors->os_error = os_error;
    return 1;
  }
  static int on_warning(TIFF*, void*, char const*, char const*, va_list) { return 1; }
};

struct TiffClose {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, TiffClose>;

using TiffOptions = std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)>;

/// Options of an open file whose messages go to `errors`.
inline TiffOptions tiff_options(TiffErrors& errors) {
  TiffOptions options(TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), TiffErrors::on_error, &errors);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), TiffErrors::on_warning, &errors);
  return options;
}

} // namespace abbe::image
