// SPDX-License-Identifier: MIT
#include "image/bytes.hpp"
#include "image/texels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

/// Formats that are a header and numbers: Netpbm, BMP, TGA, Radiance HDR.
namespace abbe::image {
namespace {

void set(Texels& out, std::int64_t x, std::int64_t y, double r, double g, double b) {
  float* const to = &out.rgba[4 * static_cast<std::size_t>(y * out.width + x)];
  to[0] = static_cast<float>(r);
  to[1] = static_cast<float>(g);
  to[2] = static_cast<float>(b);
}

Result<Texels> whole(Result<Texels> texels, Bytes const& in, std::string const& name) {
  if (in.too_short()) return damaged_texels(name, "it breaks off");
  return texels;
}

} // namespace

Result<Texels> read_netpbm_texels(std::string_view bytes, std::string const& name) {
  char const kind = bytes[1];
  bool const letters = kind == '2' || kind == '3', colours = kind == '3' || kind == '6';
  Bytes in(bytes, 2);
  std::int64_t const width = in.decimal(), height = in.decimal(), most = in.decimal();
  if (in.too_short() || most <= 0 || most > 65535)
    return damaged_texels(name, "its header is wrong");
  if (width > 0 && height > 0
      && static_cast<double>(width) * static_cast<double>(height) > static_cast<double>(in.left()))
    return damaged_texels(name, "it breaks off");
  auto out = make_texels(width, height, name);
  if (!out) return out;
  auto const sample = [&] {
    unsigned value = 0;
    if (letters) {
      value = static_cast<unsigned>(in.decimal());
    } else {
      value = in.next();
      if (most > 255) value = value << 8 | in.next();
    }
    return std::min(1.0, value / static_cast<double>(most));
  };
  for (std::int64_t y = 0; y < height && !in.too_short(); ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      double const r = sample();
      double const g = colours ? sample() : r;
      set(*out, x, y, r, g, colours ? sample() : r);
    }
  return whole(std::move(out), in, name);
}

Result<Texels> read_bmp_texels(std::string_view bytes, std::string const& name) {
  Bytes in(bytes, 10);
  std::size_t const start = in.little32(), head = in.little32();
  std::int64_t const width = static_cast<std::int32_t>(in.little32());
  std::int64_t const rows = static_cast<std::int32_t>(in.little32());
  in.skip(2);
  unsigned const bits = in.little16(), packing = in.little32();
  in.skip(12);
  std::size_t colours = in.little32();
  if (packing != 0 || (bits != 1 && bits != 4 && bits != 8 && bits != 24 && bits != 32))
    return Error{"E0516", "'" + name
                              + "' is a BMP file of a kind that is not read: save it "
                                "uncompressed"};
  std::int64_t const height = std::abs(rows);
  if (static_cast<double>(width) * static_cast<double>(height) * bits / 8
      > static_cast<double>(bytes.size()))
    return damaged_texels(name, "it breaks off");
  auto out = make_texels(width, height, name);
  if (!out) return out;
  out->default_gamma = -1;
  std::vector<std::uint32_t> palette;
  if (bits <= 8) {
    if (colours == 0 || colours > 256) colours = std::size_t{1} << bits;
    in.go_to(14 + head);
    for (std::size_t k = 0; k < colours; ++k) palette.push_back(in.little32() & 0xffffffU);
    out->index.resize(out->rgba.size() / 4);
  }
  auto const colour = [&](std::int64_t x, std::int64_t y, std::uint32_t bgr) {
    set(*out, x, y, (bgr >> 16 & 255) / 255.0, (bgr >> 8 & 255) / 255.0, (bgr & 255) / 255.0);
  };
  auto const row_bytes = static_cast<std::size_t>((width * bits + 31) / 32 * 4);
  for (std::int64_t row = 0; row < height && !in.too_short(); ++row) {
    std::int64_t const y = rows > 0 ? height - 1 - row : row;
    in.go_to(start + static_cast<std::size_t>(row) * row_bytes);
    unsigned held = 0, left = 0;
    for (std::int64_t x = 0; x < width; ++x) {
      if (bits > 8) {
        std::uint32_t const blue = in.next(), green = in.next(), red = in.next();
        if (bits == 32) in.next();
        colour(x, y, red << 16 | green << 8 | blue);
        continue;
      }
      if (left == 0) {
        held = in.next();
        left = 8;
      }
      left -= bits;
      unsigned const number = held >> left & ((1U << bits) - 1);
      out->index[static_cast<std::size_t>(y * width + x)] = static_cast<std::uint16_t>(number);
      colour(x, y, number < palette.size() ? palette[number] : 0);
    }
  }
  return whole(std::move(out), in, name);
}

Result<Texels> read_tga_texels(std::string_view bytes, std::string const& name) {
  Bytes in(bytes);
  unsigned const note = in.next(), mapped = in.next(), type = in.next();
  unsigned const first = in.little16(), count = in.little16(), entry_bits = in.next();
  in.skip(4);
  std::int64_t const width = in.little16(), height = in.little16();
  unsigned const bits = in.next(), order = in.next();
  unsigned const kind = type & 7;
  bool const packed = (type & 8) != 0;
  bool const fits = kind == 1   ? mapped == 1 && bits == 8
                    : kind == 3 ? bits == 8
                                : kind == 2 && (bits == 24 || bits == 32);
  if (!fits || (mapped != 0 && entry_bits != 24 && entry_bits != 32))
    return Error{"E0516", "'" + name + "' is a TGA file of a kind that is not read"};
  if (static_cast<double>(width) * static_cast<double>(height)
      > 128.0 * static_cast<double>(bytes.size()))
    return damaged_texels(name, "it breaks off");
  auto out = make_texels(width, height, name);
  if (!out) return out;
  out->default_gamma = -1;
  in.skip(note);
  struct Pixel {
    unsigned r = 0, g = 0, b = 0, a = 255, number = 0;
  };
  auto const colour = [&](unsigned size) {
    Pixel p;
    p.b = in.next();
    p.g = in.next();
    p.r = in.next();
    if (size == 32) p.a = in.next();
    return p;
  };
  std::vector<Pixel> palette(mapped != 0 ? first + count : 0U);
  for (std::size_t k = first; k < palette.size(); ++k) palette[k] = colour(entry_bits);
  if (kind == 1) out->index.resize(out->rgba.size() / 4);
  out->has_alpha = bits == 32;
  auto const pixel = [&] {
    if (kind == 2) return colour(bits);
    Pixel p;
    p.number = in.next();
    if (kind == 3)
      p.r = p.g = p.b = p.number;
    else if (p.number < palette.size())
      p = {palette[p.number].r, palette[p.number].g, palette[p.number].b, 255, p.number};
    return p;
  };
  unsigned run = 0;
  bool repeats = false;
  Pixel latest;
  for (std::int64_t row = 0; row < height && !in.too_short(); ++row)
    for (std::int64_t x = 0; x < width; ++x) {
      bool const fresh = packed && run == 0;
      if (fresh) {
        unsigned const head = in.next();
        run = (head & 127) + 1;
        repeats = (head & 128) != 0;
      }
      if (!packed || fresh || !repeats) latest = pixel();
      if (packed) --run;
      std::int64_t const y = (order & 32) != 0 ? row : height - 1 - row;
      set(*out, x, y, latest.r / 255.0, latest.g / 255.0, latest.b / 255.0);
      auto const place = static_cast<std::size_t>(y * width + x);
      if (out->has_alpha) out->rgba[4 * place + 3] = static_cast<float>(latest.a) / 255;
      if (kind == 1) out->index[place] = static_cast<std::uint16_t>(latest.number);
    }
  return whole(std::move(out), in, name);
}

Result<Texels> read_hdr_texels(std::string_view bytes, std::string const& name) {
  Bytes in(bytes);
  while (!in.too_short() && !in.line().empty()) {
  }
  std::string const size = in.line();
  long height = 0, width = 0;
  if (std::sscanf(size.c_str(), "-Y %ld +X %ld", &height, &width) != 2)
    return damaged_texels(name, "its size is not '-Y height +X width'");
  if (width > 0 && height > 0
      && static_cast<double>(width) * static_cast<double>(height)
             > 64.0 * static_cast<double>(bytes.size()))
    return damaged_texels(name, "it breaks off");
  auto out = make_texels(width, height, name);
  if (!out) return out;
  out->gamma = 1;
  std::vector<unsigned> row(4 * static_cast<std::size_t>(width));
  auto const columns = static_cast<std::size_t>(width);
  for (long y = 0; y < height && !in.too_short(); ++y) {
    unsigned const a = in.next(), b = in.next(), c = in.next(), d = in.next();
    bool const packed = a == 2 && b == 2 && (c << 8 | d) == static_cast<unsigned>(width);
    if (packed) {
      for (std::size_t part = 0; part < 4; ++part)
        for (std::size_t x = 0; x < columns && !in.too_short();) {
          unsigned count = in.next();
          bool const repeats = count > 128;
          if (repeats) count -= 128;
          unsigned value = repeats ? in.next() : 0;
          for (; count > 0 && x < columns; --count, ++x)
            row[4 * x + part] = repeats ? value : in.next();
        }
    } else {
      unsigned const head[] = {a, b, c, d};
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = k < 4 ? head[k] : in.next();
    }
    for (std::size_t x = 0; x < columns; ++x) {
      double const scale =
          row[4 * x + 3] == 0 ? 0 : std::ldexp(1.0, static_cast<int>(row[4 * x + 3]) - 136);
      auto const light = [&](std::size_t part) { return (row[4 * x + part] + 0.5) * scale; };
      set(*out, static_cast<std::int64_t>(x), y, light(0), light(1), light(2));
    }
  }
  return whole(std::move(out), in, name);
}

} // namespace abbe::image
