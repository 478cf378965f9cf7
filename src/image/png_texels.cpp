// SPDX-License-Identifier: MIT
#include "image/png_reader.hpp"
#include "image/texels.hpp"

#include <algorithm>
#include <cstring>

namespace abbe::image {
namespace {

struct Source {
  std::string_view bytes;
  std::size_t at = 0;
};

void take(png_structp png, png_bytep out, png_size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.bytes.size() - source.at) png_error(png, "it breaks off");
  std::memcpy(out, source.bytes.data() + source.at, count);
  source.at += count;
}

double gamma_of(PngReader const& reader) {
  double file_gamma = 0;
  if (png_get_valid(reader.png(), reader.info(), PNG_INFO_sRGB)) return -1;
  if (png_get_gAMA(reader.png(), reader.info(), &file_gamma) != 0 && file_gamma > 0)
    return 1 / file_gamma;
  return 0;
}

/// Rows of bytes as the file has them, one sample of a palette a byte.
Result<std::vector<png_byte>> rows_of(PngReader const& reader, std::size_t row_bytes,
                                      std::size_t height) {
  std::vector<png_byte> bytes(row_bytes * height);
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y) rows[y] = bytes.data() + y * row_bytes;
  bool const read = reader.guarded([&] { png_read_image(reader.png(), rows.data()); });
  if (!read) return Error{"E0513", reader.message()};
  return bytes;
}

void fill_palette(PngReader const& reader, std::vector<png_byte> const& bytes, Texels& out) {
  png_colorp palette = nullptr;
  int colours = 0;
  png_get_PLTE(reader.png(), reader.info(), &palette, &colours);
  png_bytep alpha = nullptr;
  int alphas = 0;
  png_get_tRNS(reader.png(), reader.info(), &alpha, &alphas, nullptr);
  out.has_alpha = alphas > 0;
  out.index.assign(bytes.begin(), bytes.end());
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    if (bytes[k] >= colours) continue;
    png_color const& c = palette[bytes[k]];
    float* const to = &out.rgba[4 * k];
    to[0] = static_cast<float>(c.red) / 255;
    to[1] = static_cast<float>(c.green) / 255;
    to[2] = static_cast<float>(c.blue) / 255;
    to[3] = bytes[k] < alphas ? static_cast<float>(alpha[bytes[k]]) / 255 : 1;
  }
}

void fill(std::vector<png_byte> const& bytes, int bits, int channels, Texels& out) {
  png_byte const* in = bytes.data();
  out.has_alpha = channels == 4;
  for (std::size_t k = 0; k < out.rgba.size(); k += 4)
    for (int c = 0; c < channels; ++c) {
      unsigned code = *in++;
      if (bits == 16) code = code << 8 | *in++;
      out.rgba[k + static_cast<std::size_t>(c)] =
          static_cast<float>(code) / (bits == 16 ? 65535.0F : 255.0F);
    }
}

} // namespace

Result<Texels> read_png_texels(std::string_view bytes, std::string const& name) {
  Source source{bytes};
  bool const fit = png_chunks_fit(bytes.size(), [&](std::uint64_t at, png_byte* head) {
    std::memcpy(head, bytes.data() + at, 8);
    return true;
  });
  if (!fit) return damaged_texels(name, "it breaks off within a chunk");
  PngReader const reader;
  bool const begun = reader.guarded([&] {
    png_set_user_limits(reader.png(), 1U << 20, 1U << 20);
    png_set_chunk_malloc_max(reader.png(), std::max<png_alloc_size_t>(bytes.size(), 1U << 16));
    png_set_read_fn(reader.png(), &source, take);
    png_read_info(reader.png(), reader.info());
  });
  if (!begun) return damaged_texels(name, reader.message());
  auto const width = png_get_image_width(reader.png(), reader.info());
  auto const height = png_get_image_height(reader.png(), reader.info());
  if (static_cast<double>(width) * height > reader.most_pixels(bytes.size()))
    return damaged_texels(name, "it is too short for its size");
  auto out = make_texels(width, height, name);
  if (!out) return out;
  bool const palette = png_get_color_type(reader.png(), reader.info()) == PNG_COLOR_TYPE_PALETTE;
  bool const ready = reader.guarded([&] {
    if (palette)
      png_set_packing(reader.png());
    else
      png_set_expand(reader.png());
    if (!palette) png_set_gray_to_rgb(reader.png());
    png_set_interlace_handling(reader.png());
    png_read_update_info(reader.png(), reader.info());
  });
  if (!ready) return damaged_texels(name, reader.message());
  auto const rows = rows_of(reader, png_get_rowbytes(reader.png(), reader.info()), height);
  if (!rows) return damaged_texels(name, rows.error().message);
  out->gamma = gamma_of(reader);
  out->default_gamma = -1;
  if (palette)
    fill_palette(reader, *rows, *out);
  else
    fill(*rows, png_get_bit_depth(reader.png(), reader.info()),
         png_get_channels(reader.png(), reader.info()), *out);
  return out;
}

} // namespace abbe::image
