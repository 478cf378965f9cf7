// SPDX-License-Identifier: MIT
#include "image/texels.hpp"
#include "image/tiff_handle.hpp"

#include <algorithm>
#include <cstring>

namespace abbe::image {
namespace {

/// A file in memory, as libtiff reads it.
struct Source {
  std::string_view bytes;
  std::uint64_t at = 0;

  static Source& of(thandle_t handle) { return *static_cast<Source*>(handle); }
  static tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
    Source& source = of(handle);
    if (source.at >= source.bytes.size() || count < 0) return 0;
    auto const given =
        std::min<std::uint64_t>(static_cast<std::uint64_t>(count), source.bytes.size() - source.at);
    std::memcpy(to, source.bytes.data() + source.at, given);
    source.at += given;
    return static_cast<tmsize_t>(given);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return 0; }
  static toff_t seek(thandle_t handle, toff_t place, int from) {
    Source& source = of(handle);
    source.at = from == SEEK_SET   ? place
                : from == SEEK_CUR ? source.at + place
                                   : source.bytes.size() + place;
    return source.at;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
};

/// How the samples of a picture lie in its file.
struct Layout {
  std::uint32_t width = 0, height = 0, piece_width = 0, piece_height = 0;
  std::uint16_t bits = 1, samples = 1, photometric = 0, planes = 1, format = SAMPLEFORMAT_UINT;
  std::uint16_t compression = COMPRESSION_NONE, orientation = ORIENTATION_TOPLEFT;
  bool tiled = false, alpha = false, associated = false;
  std::uint16_t* palette[3] = {};
};

Layout layout_of(TIFF* tiff) {
  Layout out;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &out.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &out.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &out.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &out.samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &out.format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &out.compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &out.orientation);
  if (TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &out.photometric) == 0)
    out.photometric = out.samples >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK;
  std::uint16_t planar = PLANARCONFIG_CONTIG, extra = 0, *kinds = nullptr;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planar);
  if (planar == PLANARCONFIG_SEPARATE) out.planes = out.samples;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra, &kinds);
  out.associated = extra > 0 && kinds[0] == EXTRASAMPLE_ASSOCALPHA;
  out.alpha = out.associated || (extra > 0 && kinds[0] == EXTRASAMPLE_UNASSALPHA);
  if (out.photometric == PHOTOMETRIC_PALETTE
      && TIFFGetField(tiff, TIFFTAG_COLORMAP, &out.palette[0], &out.palette[1], &out.palette[2])
             == 0)
    out.palette[0] = nullptr;
  out.tiled = TIFFIsTiled(tiff) != 0;
  if (out.tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &out.piece_width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &out.piece_height);
  } else {
    out.piece_width = out.width;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &out.piece_height);
    out.piece_height = std::min(out.piece_height, out.height);
  }
  return out;
}

/// Bytes of samples that a byte of the file can stand for. LZW: 4096 in 12 bits; deflate: 258 in 2
/// bits; faxes have no bound but that nobody sends longer ones.
double best_ratio(std::uint16_t compression) {
  switch (compression) {
  case COMPRESSION_NONE:
    return 1;
  case COMPRESSION_PACKBITS:
    return 64;
  case COMPRESSION_LZW:
    return 2731;
  case COMPRESSION_DEFLATE:
  case COMPRESSION_ADOBE_DEFLATE:
    return 1032;
  case COMPRESSION_JPEG:
  case COMPRESSION_OJPEG:
    return 3 * 512;
  default:
    return 4096;
  }
}

/// Are the samples numbers that stand for themselves? Else libtiff makes colours of them.
bool plain(Layout const& of) {
  bool const whole = of.format == SAMPLEFORMAT_UINT
                     && (of.bits == 1 || of.bits == 2 || of.bits == 4 || of.bits == 8
                         || of.bits == 16 || of.bits == 32);
  bool const real = of.format == SAMPLEFORMAT_IEEEFP && of.bits == 32;
  bool const grey =
      of.photometric == PHOTOMETRIC_MINISBLACK || of.photometric == PHOTOMETRIC_MINISWHITE;
  bool const palette =
      of.photometric == PHOTOMETRIC_PALETTE && of.palette[0] != nullptr && of.bits <= 8 && !real;
  bool const rgb = of.photometric == PHOTOMETRIC_RGB && of.samples >= 3;
  return (whole || real) && (grey || palette || rgb) && of.orientation == ORIENTATION_TOPLEFT
         && of.piece_width > 0 && of.piece_height > 0;
}

/// Sample `k` of a row of samples: 0..1, or as it is where it is real.
double sample_at(std::uint8_t const* row, std::size_t k, Layout const& of, unsigned& code) {
  if (of.bits == 32) {
    std::uint32_t word = 0;
    std::memcpy(&word, row + 4 * k, 4);
    if (of.format == SAMPLEFORMAT_UINT) return word / 4294967295.0;
    float real = 0;
    std::memcpy(&real, &word, 4);
    return static_cast<double>(real);
  }
  if (of.bits == 16) {
    std::uint16_t word = 0;
    std::memcpy(&word, row + 2 * k, 2);
    code = word;
    return word / 65535.0;
  }
  std::size_t const bit = k * of.bits, shift = 8 - of.bits - bit % 8;
  unsigned const most = (1U << of.bits) - 1;
  code = row[bit / 8] >> shift & most;
  return static_cast<double>(code) / most;
}

/// Where the samples of a plane go.
class Filler {
public:
  Filler(Layout const& of, Texels& out) : of_(of), out_(out) {
    if (of.photometric == PHOTOMETRIC_PALETTE) out.index.resize(out.rgba.size() / 4);
    colours_ = of.photometric == PHOTOMETRIC_RGB ? 3 : 1;
    out.has_alpha = of.alpha && of.samples > colours_;
    out.premultiplied = out.has_alpha && of.associated;
  }
  /// One row of a strip or tile, which begins at (x, y). @param plane of those apart
  void row(std::uint8_t const* from, std::uint32_t x, std::uint32_t y, std::uint16_t plane) {
    bool const apart = of_.planes > 1;
    std::uint32_t const count = std::min(of_.piece_width, of_.width - x);
    std::size_t const each = apart ? 1 : of_.samples;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t const to = std::size_t{y} * of_.width + x + i;
      for (std::size_t s = 0; s < each; ++s) {
        unsigned code = 0;
        double const value = sample_at(from, i * each + s, of_, code);
        put(to, apart ? plane : s, value, code);
      }
    }
  }

private:
  void put(std::size_t to, std::size_t sample, double value, unsigned code) {
    float* const rgba = &out_.rgba[4 * to];
    if (sample >= colours_) {
      if (sample == colours_ && out_.has_alpha) rgba[3] = static_cast<float>(value);
    } else if (colours_ == 3) {
      rgba[sample] = static_cast<float>(value);
    } else if (!out_.index.empty()) {
      out_.index[to] = static_cast<std::uint16_t>(code);
      for (std::size_t c = 0; c < 3; ++c)
        rgba[c] = static_cast<float>(of_.palette[c][code]) / 65535;
    } else {
      if (of_.photometric == PHOTOMETRIC_MINISWHITE) value = 1 - value;
      rgba[0] = rgba[1] = rgba[2] = static_cast<float>(value);
    }
  }

  Layout const& of_;
  Texels& out_;
  std::size_t colours_ = 1;
};

bool read_plain(TIFF* tiff, Layout const& of, Texels& out) {
  Filler filler(of, out);
  tmsize_t const size = of.tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff);
  std::size_t const row_bytes =
      static_cast<std::size_t>(of.tiled ? TIFFTileRowSize(tiff) : TIFFVStripSize(tiff, 1));
  std::size_t const needed =
      (std::size_t{of.piece_width} * (of.planes > 1 ? 1 : of.samples) * of.bits + 7) / 8;
  if (size <= 0 || row_bytes < needed
      || row_bytes * of.piece_height > static_cast<std::size_t>(size))
    return false;
  std::vector<std::uint8_t> piece(static_cast<std::size_t>(size));
  for (std::uint16_t plane = 0; plane < of.planes; ++plane)
    for (std::uint32_t y = 0; y < of.height; y += of.piece_height)
      for (std::uint32_t x = 0; x < of.width; x += of.piece_width) {
        tmsize_t const read =
            of.tiled
                ? TIFFReadEncodedTile(tiff, TIFFComputeTile(tiff, x, y, 0, plane), piece.data(), -1)
                : TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, y, plane), piece.data(), -1);
        std::uint32_t const rows = std::min(of.piece_height, of.height - y);
        if (read < 0 || static_cast<std::size_t>(read) < rows * row_bytes) return false;
        for (std::uint32_t row = 0; row < rows; ++row)
          filler.row(piece.data() + row * row_bytes, x, y + row, plane);
      }
  return true;
}

/// As libtiff makes colours of samples of any kind, 8 bits each.
bool read_converted(TIFF* tiff, Layout const& of, Texels& out) {
  std::vector<std::uint32_t> raster(out.rgba.size() / 4);
  if (TIFFReadRGBAImageOriented(tiff, of.width, of.height, raster.data(), ORIENTATION_TOPLEFT, 1)
      == 0)
    return false;
  out.has_alpha = of.alpha;
  out.premultiplied = of.alpha;
  for (std::size_t k = 0; k < raster.size(); ++k)
    for (std::size_t c = 0; c < (of.alpha ? 4U : 3U); ++c)
      out.rgba[4 * k + c] = static_cast<float>(raster[k] >> (8 * c) & 255) / 255;
  return true;
}

} // namespace

Result<Texels> read_tiff_texels(std::string_view bytes, std::string const& name) {
  Source source{bytes};
  TiffErrors errors;
  TiffOptions const options = tiff_options(errors);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t{1} << 28);
  Tiff const tiff(TIFFClientOpenExt(name.c_str(), "rm", &source, Source::read, Source::write,
                                    Source::seek, Source::close, Source::size, nullptr, nullptr,
                                    options.get()));
  auto const failed = [&] {
    return damaged_texels(name, errors.message.empty() ? "it breaks off" : errors.message);
  };
  if (!tiff) return failed();
  Layout const of = layout_of(tiff.get());
  double const bits = static_cast<double>(of.bits) * of.samples;
  double const most = best_ratio(of.compression) * static_cast<double>(bytes.size()) * 8 / bits;
  if (static_cast<double>(of.width) * of.height > most)
    return damaged_texels(name, "it is too short for its size");
  if (static_cast<double>(of.piece_width) * of.piece_height > std::max(most, 2048.0 * 2048.0))
    return damaged_texels(name, "its tiles are larger than the file can account for");
  auto out = make_texels(of.width, of.height, name);
  if (!out) return out;
  bool const read =
      plain(of) ? read_plain(tiff.get(), of, *out) : read_converted(tiff.get(), of, *out);
  if (!read) return failed();
  return out;
}

} // namespace abbe::image
