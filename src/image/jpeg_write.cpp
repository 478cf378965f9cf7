// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"
#include "image/display_rows.hpp"
#include "image/writer.hpp"

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <fmt/format.h>
#include <jpeglib.h>

namespace abbe::image {
namespace {

/// What libjpeg has to say; its errors jump out of the call that met them.
struct JpegErrors {
  jpeg_error_mgr manager{}; ///< first: libjpeg gives a pointer to it
  std::jmp_buf out{};
  char message[JMSG_LENGTH_MAX] = {};

  static void on_error(j_common_ptr jpeg) {
    auto* const self = reinterpret_cast<JpegErrors*>(jpeg->err);
    jpeg->err->format_message(jpeg, self->message);
    std::longjmp(self->out, 1);
  }
  static void on_message(j_common_ptr) {}
};

class JpegWriter final : public ImageWriter {
public:
  JpegWriter(ImageHead head, DisplayOptions const& options, std::filesystem::path path,
             AtomicFile file)
      : head_(std::move(head)), options_(options), path_(std::move(path)), file_(std::move(file)) {
    jpeg_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = JpegErrors::on_error;
    errors_.manager.output_message = JpegErrors::on_message;
  }
  ~JpegWriter() override { jpeg_destroy_compress(&jpeg_); }

  Status begin() {
    return guarded([&] {
      jpeg_create_compress(&jpeg_);
      jpeg_stdio_dest(&jpeg_, file_.stream());
      jpeg_.image_width = static_cast<JDIMENSION>(head_.width);
      jpeg_.image_height = static_cast<JDIMENSION>(head_.height);
      jpeg_.input_components = 3;
      jpeg_.in_color_space = JCS_RGB;
      jpeg_set_defaults(&jpeg_);
      jpeg_set_quality(&jpeg_, options_.quality, TRUE);
      jpeg_start_compress(&jpeg_, TRUE);
    });
  }

  Status write(Image const& part) override {
    Image display = tone_map(part, options_.tone);
    display.alpha.clear(); // colours are multiplied by it: shown on black
    DisplayRows rows(display, options_);
    return guarded([&] {
      for (int y = 0; y < display.height; ++y) {
        JSAMPROW row = rows.row(y).data();
        jpeg_write_scanlines(&jpeg_, &row, 1);
      }
    });
  }

  Status finish(std::vector<std::string> const&) override {
    Status const done = guarded([&] { jpeg_finish_compress(&jpeg_); });
    return done ? file_.commit() : done;
  }

private:
  /// The work may hold nothing on the stack that has a destructor.
  template <class Work>
  Status guarded(Work const& work) {
    errno = 0;
    if (setjmp(errors_.out) != 0) {
      if (errno) return file_.error(errno);
      return Error{"E0516", fmt::format("cannot write '{}': {}", path_.string(), errors_.message)};
    }
    work();
    return std::monostate{};
  }

  ImageHead head_;
  DisplayOptions options_;
  std::filesystem::path path_;
  AtomicFile file_;
  JpegErrors errors_;
  jpeg_compress_struct jpeg_{};
};

} // namespace

Result<std::unique_ptr<ImageWriter>> open_jpeg(ImageHead head, std::filesystem::path const& path,
                                               DisplayOptions const& options) {
  auto const refuse = [&](std::string const& why) {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), why)};
  };
  if (options.bits != 8)
    return refuse(fmt::format("JPEG has 8 bits per channel, not {}", options.bits));
  if (head.width > JPEG_MAX_DIMENSION || head.height > JPEG_MAX_DIMENSION)
    return refuse(fmt::format("JPEG has at most {} pixels a side", JPEG_MAX_DIMENSION));
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  auto writer = std::make_unique<JpegWriter>(std::move(head), options, path, std::move(*file));
  if (Status const begun = writer->begin(); !begun) return begun.error();
  return std::unique_ptr<ImageWriter>(std::move(writer));
}

} // namespace abbe::image
