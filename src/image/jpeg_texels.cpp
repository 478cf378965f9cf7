// SPDX-License-Identifier: MIT
#include "image/texels.hpp"

#include <csetjmp>
#include <cstdio>
#include <jerror.h>
#include <jpeglib.h>

namespace abbe::image {
namespace {

/// What libjpeg has to say, and where its errors jump to.
struct Errors {
  jpeg_error_mgr manager; // first: libjpeg hands back its address
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX] = "";
  bool broken_off = false;

  static Errors& of(j_common_ptr jpeg) { return *reinterpret_cast<Errors*>(jpeg->err); }
  static void on_error(j_common_ptr jpeg) {
    Errors& errors = of(jpeg);
    errors.manager.format_message(jpeg, errors.message);
    std::longjmp(errors.back, 1);
  }
  static void on_message(j_common_ptr jpeg, int level) {
    int const code = of(jpeg).manager.msg_code;
    if (level < 0
        && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE))
      of(jpeg).broken_off = true;
  }
};

/// A JPEG file while libjpeg reads it.
class Decoder {
public:
  Decoder() {
    jpeg.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = Errors::on_error;
    errors.manager.emit_message = Errors::on_message;
  }
  Decoder(Decoder const&) = delete;
  Decoder& operator=(Decoder const&) = delete;
  ~Decoder() { jpeg_destroy_decompress(&jpeg); }

  /// Runs a piece of work with libjpeg: false after an error. The work may hold nothing on the
  /// stack that has a destructor.
  template <class Work>
  bool guarded(Work const& work) {
    if (setjmp(errors.back) != 0) return false;
    work();
    return true;
  }

  Errors errors;
  jpeg_decompress_struct jpeg{};
};

/// Scans of a progressive file, at most: each costs as much as the whole picture.
constexpr int most_scans = 100;

void watch_scans(j_common_ptr jpeg) {
  auto* const decoder = reinterpret_cast<j_decompress_ptr>(jpeg);
  if (decoder->input_scan_number > most_scans) ERREXIT(decoder, JERR_BAD_PROGRESSION);
}

/// E0516: a sound file, of a kind that is not read.
Error unread(std::string const& name, std::string const& why) {
  return {"E0516", "'" + name + "' is not supported: " + why + "; save it as RGB or grey"};
}

} // namespace

Result<Texels> read_jpeg_texels(std::string_view bytes, std::string const& name) {
  Decoder decoder;
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg_progress_mgr progress{};
  progress.progress_monitor = watch_scans;
  auto const failed = [&] { return damaged_texels(name, decoder.errors.message); };
  bool const begun = decoder.guarded([&] {
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<unsigned char const*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
  });
  if (!begun) return failed();
  if (jpeg.arith_code) return unread(name, "its data are coded arithmetically");
  bool const grey = jpeg.jpeg_color_space == JCS_GRAYSCALE;
  if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK)
    return unread(name, "its colours are inks");
  // Each scan has a bit at least for 8 x 8 samples.
  if (static_cast<double>(jpeg.image_width) * jpeg.image_height
      > 512.0 * static_cast<double>(bytes.size()))
    return damaged_texels(name, "it is too short for its size");
  auto out = make_texels(jpeg.image_width, jpeg.image_height, name);
  if (!out) return out;
  out->default_gamma = -1;
  jpeg.out_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
  std::size_t const channels = grey ? 1 : 3;
  std::vector<JSAMPLE> row(channels * jpeg.image_width);
  JSAMPROW const rows[] = {row.data()};
  float* to = out->rgba.data();
  bool const read = decoder.guarded([&] {
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
      jpeg_read_scanlines(&jpeg, const_cast<JSAMPARRAY>(rows), 1);
      for (std::size_t x = 0; x < jpeg.output_width; ++x, to += 4)
        for (std::size_t c = 0; c < 3; ++c)
          to[c] = static_cast<float>(row[channels * x + (grey ? 0 : c)]) / 255;
    }
    jpeg_finish_decompress(&jpeg);
  });
  if (!read) return failed();
  if (decoder.errors.broken_off) return damaged_texels(name, "it breaks off");
  return out;
}

} // namespace abbe::image
