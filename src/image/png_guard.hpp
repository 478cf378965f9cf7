// SPDX-License-Identifier: MIT
#pragma once

#include <csetjmp>
#include <png.h>
#include <string>

namespace abbe::image {

/// Receives what libpng has to say; its warnings concern nothing that we use.
struct PngErrors {
  std::string message;

  static void on_error(png_structp png, png_const_charp text) {
    static_cast<PngErrors*>(png_get_error_ptr(png))->message = text;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
};

/// Runs a piece of work with libpng, whose errors jump out of it: false after an error.
/// The work may hold nothing on the stack that has a destructor.
template <class Work>
bool png_guarded(png_structp png, Work const& work) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  work();
  return true;
}

} // namespace abbe::image
