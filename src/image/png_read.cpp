// SPDX-License-Identifier: MIT
#include "image/colour.hpp"
#include "image/input_file.hpp"
#include "image/io.hpp"
#include "image/png_guard.hpp"

#include <cmath>
#include <cstring>

namespace abbe::image {
namespace {

struct Reader {
  PngErrors errors;
  png_structp png = nullptr;
  png_infop info = nullptr;

  Reader() = default;
  Reader(Reader const&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Does every chunk lie within the file? libpng allocates what a chunk claims before it reads, and
/// its own limit is a warning.
bool chunks_fit(InputFile const& file) {
  for (std::uint64_t at = 8; at + 8 <= file.size;) {
    png_byte head[8];
    if (::fseeko(file.stream.get(), static_cast<off_t>(at), SEEK_SET) != 0
        || std::fread(head, 1, sizeof head, file.stream.get()) != sizeof head)
      return false;
    std::uint64_t const length = png_get_uint_32(head);
    if (std::memcmp(head + 4, "IEND", 4) == 0) break;
    if (length + 12 > file.size - at) return false;
    at += length + 12;
  }
  std::rewind(file.stream.get());
  return true;
}

/// Header and ancillary chunks; then asks for RGB or RGBA of 8 or 16 bits.
void begin(Reader& reader, std::FILE* stream) {
  png_structp const png = reader.png;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_init_io(png, stream);
  png_read_info(png, reader.info);
}

void expand(Reader& reader) {
  png_structp const png = reader.png;
  png_set_expand(png);
  png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
}

/// Code value to linear light for this file.
std::vector<double> curve_of(Reader const& reader, int bits) {
  double file_gamma = 0;
  bool const power_law = !png_get_valid(reader.png, reader.info, PNG_INFO_sRGB)
                         && !png_get_valid(reader.png, reader.info, PNG_INFO_iCCP)
                         && png_get_gAMA(reader.png, reader.info, &file_gamma) != 0
                         && file_gamma > 0;
  std::vector<double> curve(std::size_t{1} << bits);
  for (std::size_t code = 0; code < curve.size(); ++code) {
    double const value = static_cast<double>(code) / static_cast<double>(curve.size() - 1);
    curve[code] = power_law ? std::pow(value, 1 / file_gamma) : srgb_decode(value);
  }
  return curve;
}

void decode(std::vector<png_byte> const& bytes, int bits, std::vector<double> const& curve,
            Image& image) {
  png_byte const* in = bytes.data();
  auto const next = [&]() -> unsigned {
    unsigned code = *in++;
    if (bits == 16) code = (code << 8) | *in++;
    return code;
  };
  double const full = static_cast<double>(curve.size() - 1);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    Vec3 rgb{curve[next()], 0, 0};
    rgb.y = curve[next()];
    rgb.z = curve[next()];
    if (!image.alpha.empty()) {
      double const alpha = next() / full;
      image.alpha[i] = static_cast<float>(alpha);
      rgb = alpha * rgb;
    }
    set_pixel(image, i, rgb);
  }
}

void read_texts(Reader const& reader, Image& image) {
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(reader.png, reader.info, &texts, &count);
  for (int t = 0; t < count; ++t)
    if (texts[t].key && texts[t].text) image.metadata.emplace_back(texts[t].key, texts[t].text);
}

} // namespace

Result<Image> read_png(std::filesystem::path const& path) {
  Result<InputFile> file = open_input(path);
  if (!file) return file.error();
  if (!chunks_fit(*file)) return damaged(path, "it breaks off within a chunk");
  Reader reader;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader.errors, PngErrors::on_error,
                                      PngErrors::on_warning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!reader.info) return damaged(path, "no memory to read it");
  auto const failed = [&] { return damaged(path, reader.errors.message); };
  std::FILE* const stream = file->stream.get();
  if (!png_guarded(reader.png, [&] { begin(reader, stream); })) return failed();

  auto const width = png_get_image_width(reader.png, reader.info);
  auto const height = png_get_image_height(reader.png, reader.info);
  double const bits_per_pixel =
      png_get_bit_depth(reader.png, reader.info) * png_get_channels(reader.png, reader.info);
  // Deflate at its best makes 1032 bytes of one.
  double const most = static_cast<double>(file->size) * 1032 * 8 / bits_per_pixel;
  if (Status const sane = check_size(path, width, height, most); !sane) return sane.error();

  if (!png_guarded(reader.png, [&] { expand(reader); })) return failed();
  int const bits = png_get_bit_depth(reader.png, reader.info);
  std::size_t const row_bytes = png_get_rowbytes(reader.png, reader.info);
  try {
    std::vector<png_byte> bytes(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = bytes.data() + y * row_bytes;
    bool const read = png_guarded(reader.png, [&] {
      png_read_image(reader.png, rows.data());
      png_read_end(reader.png, reader.info);
    });
    if (!read) return failed();
    Image image = make_image(static_cast<int>(width), static_cast<int>(height));
    if (png_get_channels(reader.png, reader.info) == 4) image.alpha.resize(image.pixels());
    decode(bytes, bits, curve_of(reader, bits), image);
    read_texts(reader, image);
    return image;
  } catch (std::bad_alloc const&) {
    return Error{"E0514", "'" + path.string() + "' does not fit into memory"};
  }
}

} // namespace abbe::image
