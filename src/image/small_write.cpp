// SPDX-License-Identifier: MIT
/// Formats that are a head and rows of bytes: PPM, TGA, BMP and Radiance's HDR.
#include "image/atomic_file.hpp"
#include "image/display_rows.hpp"
#include "image/writer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace abbe::image {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put16(Bytes& out, unsigned value) {
  out.push_back(static_cast<std::uint8_t>(value & 0xff));
  out.push_back(static_cast<std::uint8_t>(value >> 8 & 0xff));
}
void put32(Bytes& out, std::uint32_t value) {
  put16(out, value & 0xffff);
  put16(out, value >> 16);
}

/// A file that is written byte by byte from its beginning.
class SmallWriter : public ImageWriter {
public:
  SmallWriter(ImageHead head, AtomicFile file) : head_(std::move(head)), file_(std::move(file)) {}
  Status finish(std::vector<std::string> const&) override { return file_.commit(); }
  Status put(std::uint8_t const* bytes, std::size_t count) {
    errno = 0;
    if (std::fwrite(bytes, 1, count, file_.stream()) == count) return std::monostate{};
    return file_.error(errno ? errno : EIO);
  }
  Status put(Bytes const& bytes) { return put(bytes.data(), bytes.size()); }
  virtual Status begin() = 0;

protected:
  ImageHead head_;
  AtomicFile file_;
};

/// One whose rows are codes of a display.
class DisplayWriter : public SmallWriter {
public:
  DisplayWriter(ImageHead head, AtomicFile file, DisplayOptions const& options)
      : SmallWriter(std::move(head), std::move(file)), options_(options) {}
  Status write(Image const& part) override {
    Image display = tone_map(part, options_.tone);
    if (!head_.alpha) display.alpha.clear(); // colours are multiplied by it: shown on black
    DisplayRows rows(display, options_);
    for (int y = 0; y < display.height; ++y)
      if (Status const written = put_row(rows.row(y)); !written) return written;
    return std::monostate{};
  }

protected:
  virtual Status put_row(std::span<std::uint8_t> codes) = 0;
  DisplayOptions options_;
};

class PpmWriter final : public DisplayWriter {
public:
  using DisplayWriter::DisplayWriter;
  Status begin() override {
    std::string text = "P6\n";
    for (auto const& [key, value] : head_.metadata) {
      std::string line = fmt::format("# {}: {}", key, value);
      std::replace_if(
          line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
      text += line + '\n';
    }
    text += fmt::format("{} {}\n{}\n", head_.width, head_.height, (1 << options_.bits) - 1);
    return put(reinterpret_cast<std::uint8_t const*>(text.data()), text.size());
  }

private:
  Status put_row(std::span<std::uint8_t> codes) override { return put(codes.data(), codes.size()); }
};

/// TGA and BMP have blue first.
void swap_red_and_blue(std::span<std::uint8_t> codes, std::size_t channels) {
  for (std::size_t i = 0; i + 2 < codes.size(); i += channels) std::swap(codes[i], codes[i + 2]);
}

class TgaWriter final : public DisplayWriter {
public:
  using DisplayWriter::DisplayWriter;
  Status begin() override {
    Bytes out{0, 0, static_cast<std::uint8_t>(options_.compress ? 10 : 2), 0, 0, 0, 0, 0};
    put16(out, 0); // where the picture begins
    put16(out, static_cast<unsigned>(head_.height));
    put16(out, static_cast<unsigned>(head_.width));
    put16(out, static_cast<unsigned>(head_.height));
    out.push_back(head_.alpha ? 32 : 24);
    out.push_back(head_.alpha ? 0x28 : 0x20); // from the top; bits of alpha
    return put(out);
  }

private:
  Status put_row(std::span<std::uint8_t> codes) override {
    std::size_t const size = head_.alpha ? 4 : 3;
    swap_red_and_blue(codes, size);
    return options_.compress ? put(run_lengths(codes, size)) : put(codes.data(), codes.size());
  }
  /// Packets of up to 128 pixels, which are equal or are not.
  static Bytes run_lengths(std::span<std::uint8_t const> codes, std::size_t size) {
    Bytes out;
    std::size_t const pixels = codes.size() / size;
    auto const same = [&](std::size_t a, std::size_t b) {
      return std::equal(codes.begin() + static_cast<std::ptrdiff_t>(a * size),
                        codes.begin() + static_cast<std::ptrdiff_t>((a + 1) * size),
                        codes.begin() + static_cast<std::ptrdiff_t>(b * size));
    };
    for (std::size_t at = 0; at < pixels;) {
      std::size_t run = 1;
      while (run < 128 && at + run < pixels && same(at, at + run)) ++run;
      std::size_t count = run;
      if (run == 1)
        while (count < 128 && at + count < pixels && !same(at + count - 1, at + count)) ++count;
      bool const equal = run > 1;
      if (!equal && count > 1 && at + count < pixels) --count; // the last begins a run
      out.push_back(static_cast<std::uint8_t>((equal ? 0x80 : 0) | (count - 1)));
      auto const first = codes.begin() + static_cast<std::ptrdiff_t>(at * size);
      out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>((equal ? 1 : count) * size));
      at += count;
    }
    return out;
  }
};

class BmpWriter final : public DisplayWriter {
public:
  using DisplayWriter::DisplayWriter;
  Status begin() override {
    std::size_t const size = head_.alpha ? 4 : 3;
    padding_ = (4 - static_cast<std::size_t>(head_.width) * size % 4) % 4;
    std::uint64_t const row = static_cast<std::uint64_t>(head_.width) * size + padding_;
    std::uint64_t const all = row * static_cast<std::uint64_t>(head_.height) + 54;
    if (all > 0xffffffffu)
      return Error{"E0516", "BMP holds 4 GB at most: write another kind of picture"};
    Bytes out{'B', 'M'};
    put32(out, static_cast<std::uint32_t>(all));
    put32(out, 0);
    put32(out, 54); // where the picture begins
    put32(out, 40); // bytes of what follows
    put32(out, static_cast<std::uint32_t>(head_.width));
    put32(out, static_cast<std::uint32_t>(-head_.height)); // from the top
    put16(out, 1);
    put16(out, head_.alpha ? 32 : 24);
    put32(out, 0);
    put32(out, static_cast<std::uint32_t>(all - 54));
    for (int i = 0; i < 4; ++i) put32(out, 0);
    return put(out);
  }

private:
  Status put_row(std::span<std::uint8_t> codes) override {
    swap_red_and_blue(codes, head_.alpha ? 4 : 3);
    std::array<std::uint8_t, 4> const zeros{};
    if (Status const written = put(codes.data(), codes.size()); !written) return written;
    return put(zeros.data(), padding_);
  }
  std::size_t padding_ = 0;
};

/// Ward, "Real Pixels", Graphics Gems II: three mantissas that share an exponent.
std::array<std::uint8_t, 4> rgbe(float const* rgb) {
  float const largest = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(largest > 1e-32f)) return {};
  int exponent = 0;
  double const scale = std::frexp(largest, &exponent) * 256 / double(largest);
  if (exponent > 127) return {255, 255, 255, 255};
  std::array<std::uint8_t, 4> out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::max(0.0, double(rgb[c]) * scale));
  out[3] = static_cast<std::uint8_t>(exponent + 128);
  return out;
}

class HdrWriter final : public SmallWriter {
public:
  using SmallWriter::SmallWriter;
  Status begin() override {
    std::string const text =
        fmt::format("#?RADIANCE\nSOFTWARE=abbe\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n",
                    head_.height, head_.width);
    return put(reinterpret_cast<std::uint8_t const*>(text.data()), text.size());
  }
  Status write(Image const& part) override {
    auto const width = static_cast<std::size_t>(part.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(part.height); ++y) {
      std::vector<std::array<std::uint8_t, 4>> row(width);
      for (std::size_t x = 0; x < width; ++x) row[x] = rgbe(&part.rgb[3 * (y * width + x)]);
      if (Status const written = put(bytes_of(row)); !written) return written;
    }
    return std::monostate{};
  }

private:
  /// Each of the four bytes of all pixels together, in packets that begin with their length. Rows
  /// that are too short or too long for that are stored pixel by pixel.
  static Bytes bytes_of(std::vector<std::array<std::uint8_t, 4>> const& row) {
    Bytes out;
    std::size_t const width = row.size();
    if (width < 8 || width > 0x7fff) {
      for (auto const& pixel : row) out.insert(out.end(), pixel.begin(), pixel.end());
      return out;
    }
    out = {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width & 0xff)};
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t at = 0; at < width; at += 128) {
        std::size_t const count = std::min<std::size_t>(128, width - at);
        out.push_back(static_cast<std::uint8_t>(count));
        for (std::size_t x = at; x < at + count; ++x) out.push_back(row[x][c]);
      }
    return out;
  }
};

/// @param may_have_alpha does the format keep it?
template <class Writer, class... Options>
Result<std::unique_ptr<ImageWriter>> open(ImageHead head, std::filesystem::path const& path,
                                          bool may_have_alpha, Options const&... options) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  head.alpha = head.alpha && may_have_alpha;
  auto writer = std::make_unique<Writer>(std::move(head), std::move(*file), options...);
  if (Status const begun = writer->begin(); !begun) return begun.error();
  return std::unique_ptr<ImageWriter>(std::move(writer));
}

/// @param most of width and height that the format can tell
std::optional<Error> misfit(ImageHead const& head, std::filesystem::path const& path, int bits,
                            int most_bits, std::string_view format, int most) {
  auto const refuse = [&](std::string const& why) {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), why)};
  };
  if (bits != 8 && bits != most_bits)
    return refuse(fmt::format("{} has {} bits per channel here, not {}", format,
                              most_bits == 8 ? "8" : "8 or 16", bits));
  if (head.width > most || head.height > most)
    return refuse(fmt::format("{} has at most {} pixels a side", format, most));
  return std::nullopt;
}

constexpr int any_size = 0x7fffffff;

} // namespace

Result<std::unique_ptr<ImageWriter>> open_ppm(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options) {
  if (auto const bad = misfit(head, path, options.bits, 16, "PPM", any_size)) return *bad;
  return open<PpmWriter>(std::move(head), path, false, options);
}

Result<std::unique_ptr<ImageWriter>> open_tga(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options) {
  if (auto const bad = misfit(head, path, options.bits, 8, "TGA", 0xffff)) return *bad;
  return open<TgaWriter>(std::move(head), path, true, options);
}

Result<std::unique_ptr<ImageWriter>> open_bmp(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options) {
  if (auto const bad = misfit(head, path, options.bits, 8, "BMP", any_size)) return *bad;
  return open<BmpWriter>(std::move(head), path, true, options);
}

Result<std::unique_ptr<ImageWriter>> open_hdr(ImageHead head, std::filesystem::path const& path) {
  return open<HdrWriter>(std::move(head), path, false);
}

} // namespace abbe::image
