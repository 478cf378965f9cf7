// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"
#include "image/colour.hpp"
#include "image/io.hpp"
#include "image/png_guard.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace abbe::image {
namespace {

/// A libpng writer and what its callbacks need.
struct Writer {
  PngErrors errors;
  int os_error = 0;
  std::FILE* stream = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;

  Writer() = default;
  Writer(Writer const&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }

  static void write(png_structp png, png_bytep bytes, png_size_t count) {
    auto* self = static_cast<Writer*>(png_get_io_ptr(png));
    errno = 0;
    if (std::fwrite(bytes, 1, count, self->stream) == count) return;
    self->os_error = errno ? errno : EIO;
    png_error(png, "write failed");
  }
  static void flush(png_structp) {}
};

bool is_ascii(std::string const& text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c == '\n' || (c >= 32 && c < 127); });
}

bool is_keyword(std::string const& key) {
  return !key.empty() && key.size() <= 79 && is_ascii(key) && key.front() != ' '
         && key.back() != ' ' && key.find('\n') == std::string::npos
         && key.find("  ") == std::string::npos;
}

std::vector<png_text> texts_of(Image const& image) {
  std::vector<png_text> texts;
  for (auto const& [key, value] : image.metadata) {
    png_text text{};
    text.compression = is_ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    // libpng only reads them.
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    texts.push_back(text);
  }
  return texts;
}

/// The rows of the file, one at a time: RGB or RGBA, 8 or 16 bits, big-endian.
class Rows {
public:
  Rows(Image const& display, int bits)
      : display_(display),
        bytes_(bits / 8),
        full_((1 << bits) - 1),
        channels_(display.alpha.empty() ? 3 : 4),
        row_(static_cast<std::size_t>(display.width)
             * static_cast<std::size_t>(channels_ * bytes_)) {}

  png_bytep row(int y) {
    png_bytep out = row_.data();
    auto const width = static_cast<std::size_t>(display_.width);
    std::size_t const first = static_cast<std::size_t>(y) * width;
    for (std::size_t i = first; i < first + width; ++i) {
      double const alpha = display_.alpha.empty() ? 1 : coverage(display_.alpha[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        double const light = display_.rgb[3 * i + c];
        out = put(out, srgb_encode(alpha > 0 ? std::min(light / alpha, 1.0) : 0));
      }
      if (channels_ == 4) out = put(out, alpha);
    }
    return row_.data();
  }

private:
  static double coverage(float alpha) { return alpha > 0 ? std::min<double>(alpha, 1) : 0; }
  png_bytep put(png_bytep out, double value) const {
    auto const code = static_cast<unsigned>(std::floor(full_ * value + 0.5));
    if (bytes_ == 2) *out++ = static_cast<png_byte>(code >> 8);
    *out++ = static_cast<png_byte>(code & 0xff);
    return out;
  }
  Image const& display_;
  int bytes_;
  double full_;
  int channels_;
  std::vector<png_byte> row_;
};

void encode(Writer& writer, Image const& display, int bits, Rows& rows,
            std::vector<png_text> const& texts) {
  png_structp const png = writer.png;
  // The defaults admit a million pixels a side.
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_write_fn(png, &writer, Writer::write, Writer::flush);
  png_set_IHDR(png, writer.info, static_cast<png_uint_32>(display.width),
               static_cast<png_uint_32>(display.height), bits,
               display.alpha.empty() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, writer.info, PNG_sRGB_INTENT_RELATIVE);
  png_set_text(png, writer.info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, writer.info);
  for (int y = 0; y < display.height; ++y) png_write_row(png, rows.row(y));
  png_write_end(png, writer.info);
}

} // namespace

Status write_png(Image const& image, std::filesystem::path const& path, PngOptions const& options) {
  auto const refuse = [&](std::string const& why) {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), why)};
  };
  if (Status const valid = validate(image); !valid) return valid;
  if (options.bits != 8 && options.bits != 16)
    return refuse(fmt::format("PNG has 8 or 16 bits per channel here, not {}", options.bits));
  for (auto const& [key, value] : image.metadata)
    if (!is_keyword(key))
      return refuse(
          fmt::format("PNG takes keys of 1 to 79 printable ASCII characters, not '{}'", key));
  Image const display = tone_map(image, options.tone);
  Rows rows(display, options.bits);
  std::vector<png_text> const texts = texts_of(display);

  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  Writer writer;
  writer.stream = file->stream();
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.errors, PngErrors::on_error,
                                       PngErrors::on_warning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) return file->error(ENOMEM);
  bool const done =
      png_guarded(writer.png, [&] { encode(writer, display, options.bits, rows, texts); });
  if (!done && writer.os_error) return file->error(writer.os_error);
  if (!done) return refuse(writer.errors.message);
  return file->commit();
}

} // namespace abbe::image
