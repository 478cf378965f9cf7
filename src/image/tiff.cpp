// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"
#include "image/colour.hpp"
#include "image/input_file.hpp"
#include "image/tiff_handle.hpp"
#include "image/writer.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace abbe::image {
namespace {

/// libtiff closes its descriptor, so it gets one of its own.
Tiff open_tiff(std::FILE* stream, std::filesystem::path const& path, char const* mode,
               TiffErrors& errors) {
  TiffOptions const options = tiff_options(errors);
  int const descriptor = ::dup(::fileno(stream));
  if (descriptor < 0) return nullptr;
  ::lseek(descriptor, 0, SEEK_SET);
  Tiff tiff(TIFFFdOpenExt(descriptor, path.c_str(), mode, options.get()));
  if (!tiff) ::close(descriptor);
  return tiff;
}

class TiffWriter final : public ImageWriter {
public:
  TiffWriter(ImageHead head, std::filesystem::path const& path, AtomicFile file)
      : head_(std::move(head)), file_(std::move(file)) {
    tiff_ = open_tiff(file_.stream(), path, "w", errors_);
  }

  Status begin() { return tiff_ && set_tags() ? Status(std::monostate{}) : failed(); }

  Status write(Image const& rows) override {
    auto const width = static_cast<std::size_t>(rows.width);
    std::vector<float> row(3 * width);
    for (int y = 0; y < rows.height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        Vec3 xyz = linear_srgb_to_xyz(pixel(rows, static_cast<std::size_t>(y) * width + x));
        if (!(xyz.y > 0)) xyz = Vec3(0);
        for (int c = 0; c < 3; ++c) row[3 * x + c] = static_cast<float>(xyz[c]);
      }
      if (TIFFWriteScanline(tiff_.get(), row.data(), next_++) < 0) return failed();
    }
    return std::monostate{};
  }

  Status finish(std::vector<std::string> const& late) override {
    ABBE_ASSERT(late.size() == head_.late_keys.size());
    std::string text;
    for (auto const& [key, value] : head_.metadata) text += key + ": " + value + "\n";
    for (std::size_t i = 0; i < late.size(); ++i)
      text += head_.late_keys[i] + ": " + late[i] + "\n";
    if (!text.empty() && !TIFFSetField(tiff_.get(), TIFFTAG_IMAGEDESCRIPTION, text.c_str()))
      return failed();
    if (!TIFFFlush(tiff_.get())) return failed();
    tiff_.reset(); // writes too, and can fail
    if (!errors_.message.empty()) return failed();
    return file_.commit();
  }

private:
  Error failed() const { return file_.error(errors_.os_error ? errors_.os_error : EIO); }

  bool set_tags() {
    TIFF* const tiff = tiff_.get();
    bool ok = TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(head_.width)) != 0;
    ok = ok && TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(head_.height));
    ok = ok && TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    ok = ok && TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    ok = ok && TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    ok = ok && TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_LOGLUV);
    ok = ok && TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_SGILOG);
    ok = ok && TIFFSetField(tiff, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
    ok = ok && TIFFSetField(tiff, TIFFTAG_SGILOGENCODE, SGILOGENCODE_NODITHER);
    return ok && TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
  }

  ImageHead head_;
  AtomicFile file_;
  TiffErrors errors_;
  Tiff tiff_;
  std::uint32_t next_ = 0; ///< row
};

void read_description(TIFF* tiff, Image& image) {
  char const* text = nullptr;
  if (!TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) || !text) return;
  std::string_view rest = text;
  while (!rest.empty()) {
    std::string_view const line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    std::size_t const colon = line.find(": ");
    if (colon != std::string_view::npos)
      image.metadata.emplace_back(line.substr(0, colon), line.substr(colon + 2));
    else if (!line.empty())
      image.metadata.emplace_back("ImageDescription", line);
  }
}

/// Size and kind, before anything is allocated.
Status check_tiff(TIFF* tiff, std::filesystem::path const& path, std::uint64_t file_size) {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t photometric = 0;
  std::uint16_t compression = 0;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  if (photometric != PHOTOMETRIC_LOGLUV
      || (compression != COMPRESSION_SGILOG && compression != COMPRESSION_SGILOG24))
    return unsupported(path, "of TIFF only LogLuv is read");
  if (TIFFIsTiled(tiff)) return unsupported(path, "its LogLuv data are in tiles");
  // Four planes of runs of at most 129 pixels, each run in 2 bytes.
  return check_size(path, width, height, static_cast<double>(file_size) * 129 / 8);
}

} // namespace

Result<std::unique_ptr<ImageWriter>> open_tiff_logluv(ImageHead head,
                                                      std::filesystem::path const& path) {
  if (head.alpha)
    return Error{"E0516", fmt::format("cannot write '{}': LogLuv TIFF has no transparency; write "
                                      ".exr or .png, or render without alpha",
                                      path.string())};
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  auto writer = std::make_unique<TiffWriter>(std::move(head), path, std::move(*file));
  if (Status const begun = writer->begin(); !begun) return begun.error();
  return std::unique_ptr<ImageWriter>(std::move(writer));
}

Result<Image> read_tiff(std::filesystem::path const& path) {
  Result<InputFile> file = open_input(path);
  if (!file) return file.error();
  TiffErrors errors;
  Tiff const tiff = open_tiff(file->stream.get(), path, "r", errors);
  if (!tiff) return damaged(path, errors.message);
  if (Status const sane = check_tiff(tiff.get(), path, file->size); !sane) return sane.error();
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFSetField(tiff.get(), TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
  std::vector<float> row(3 * std::size_t{width});
  if (TIFFScanlineSize64(tiff.get()) != row.size() * sizeof(float))
    return unsupported(path, "its LogLuv data are not 3 samples per pixel in one plane");
  try {
    Image image = make_image(static_cast<int>(width), static_cast<int>(height));
    for (std::uint32_t y = 0; y < height; ++y) {
      if (TIFFReadScanline(tiff.get(), row.data(), y) < 0) return damaged(path, errors.message);
      for (std::size_t x = 0; x < width; ++x)
        set_pixel(image, std::size_t{y} * width + x,
                  xyz_to_linear_srgb({row[3 * x], row[3 * x + 1], row[3 * x + 2]}));
    }
    read_description(tiff.get(), image);
    return image;
  } catch (std::bad_alloc const&) {
    return Error{"E0514", fmt::format("'{}' does not fit into memory", path.string())};
  }
}

} // namespace abbe::image
