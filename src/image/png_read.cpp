// SPDX-License-Identifier: MIT
#include "image/colour.hpp"
#include "image/input_file.hpp"
#include "image/io.hpp"
#include "image/png_reader.hpp"

#include <cmath>

namespace abbe::image {
namespace {

/// @see png_chunks_fit
bool chunks_fit(InputFile const& file) {
  std::FILE* const stream = file.stream.get();
  bool const fit = png_chunks_fit(file.size, [&](std::uint64_t at, png_byte* head) {
    return ::fseeko(stream, static_cast<off_t>(at), SEEK_SET) == 0
           && std::fread(head, 1, 8, stream) == 8;
  });
  std::rewind(stream);
  return fit;
}

/// Header and ancillary chunks; then asks for RGB or RGBA of 8 or 16 bits.
void begin(PngReader const& reader, std::FILE* stream) {
  png_structp const png = reader.png();
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_init_io(png, stream);
  png_read_info(png, reader.info());
}

void expand(PngReader const& reader) {
  png_structp const png = reader.png();
  png_set_expand(png);
  png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info());
}

/// Code value to linear light for this file.
std::vector<double> curve_of(PngReader const& reader, int bits) {
  double file_gamma = 0;
  bool const power_law = !png_get_valid(reader.png(), reader.info(), PNG_INFO_sRGB)
                         && !png_get_valid(reader.png(), reader.info(), PNG_INFO_iCCP)
                         && png_get_gAMA(reader.png(), reader.info(), &file_gamma) != 0
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

void read_texts(PngReader const& reader, Image& image) {
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(reader.png(), reader.info(), &texts, &count);
  for (int t = 0; t < count; ++t)
    if (texts[t].key && texts[t].text) image.metadata.emplace_back(texts[t].key, texts[t].text);
}

} // namespace

Result<Image> read_png(std::filesystem::path const& path) {
  Result<InputFile> file = open_input(path);
  if (!file) return file.error();
  if (!chunks_fit(*file)) return damaged(path, "it breaks off within a chunk");
  PngReader const reader;
  auto const failed = [&] { return damaged(path, reader.message()); };
  std::FILE* const stream = file->stream.get();
  if (!reader.guarded([&] { begin(reader, stream); })) return failed();

  auto const width = png_get_image_width(reader.png(), reader.info());
  auto const height = png_get_image_height(reader.png(), reader.info());
  if (Status const sane = check_size(path, width, height, reader.most_pixels(file->size)); !sane)
    return sane.error();

  if (!reader.guarded([&] { expand(reader); })) return failed();
  int const bits = png_get_bit_depth(reader.png(), reader.info());
  std::size_t const row_bytes = png_get_rowbytes(reader.png(), reader.info());
  try {
    std::vector<png_byte> bytes(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = bytes.data() + y * row_bytes;
    bool const read = reader.guarded([&] {
      png_read_image(reader.png(), rows.data());
      png_read_end(reader.png(), reader.info());
    });
    if (!read) return failed();
    Image image = make_image(static_cast<int>(width), static_cast<int>(height));
    if (png_get_channels(reader.png(), reader.info()) == 4) image.alpha.resize(image.pixels());
    decode(bytes, bits, curve_of(reader, bits), image);
    read_texts(reader, image);
    return image;
  } catch (std::bad_alloc const&) {
    return Error{"E0514", "'" + path.string() + "' does not fit into memory"};
  }
}

} // namespace abbe::image
