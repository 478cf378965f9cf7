// SPDX-License-Identifier: MIT
#include "image/bytes.hpp"
#include "image/texels.hpp"

#include <algorithm>

namespace abbe::image {
namespace {

/// The sub-blocks that follow, as one.
std::string blocks(Bytes& in) {
  std::string out;
  for (unsigned size = in.next(); size != 0 && !in.too_short(); size = in.next())
    for (; size > 0; --size) out += static_cast<char>(in.next());
  return out;
}

using Palette = std::vector<unsigned>; ///< r g b, one after another
Palette palette_of(Bytes& in, unsigned flags) {
  Palette out(3 * (std::size_t{2} << (flags & 7)));
  for (unsigned& part : out) part = in.next();
  return out;
}

/// Numbers of colours, by the format's variant of LZW.
std::vector<std::uint16_t> unpack(std::string const& packed, unsigned least, std::size_t count) {
  std::vector<std::uint16_t> out;
  unsigned const clear = 1U << least, end = clear + 1;
  struct Word {
    unsigned before, last, length;
  };
  std::vector<Word> words(4096);
  for (unsigned k = 0; k < clear; ++k) words[k] = {0, k, 1};
  unsigned next = clear + 2, size = least + 1, held = 0, bits = 0, before = clear;
  for (std::size_t at = 0; out.size() < count;) {
    while (bits < size && at < packed.size()) {
      held |= static_cast<unsigned>(static_cast<unsigned char>(packed[at++])) << bits;
      bits += 8;
    }
    if (bits < size) break;
    unsigned const code = held & ((1U << size) - 1);
    held >>= size;
    bits -= size;
    if (code == end) break;
    if (code == clear) {
      next = clear + 2;
      size = least + 1;
      before = clear;
      continue;
    }
    if (code > next || (before == clear && code >= clear)) break;
    if (before != clear && next < 4096) {
      unsigned first = code < next ? code : before;
      while (words[first].length > 1) first = words[first].before;
      words[next] = {before, words[first].last, words[before].length + 1};
      ++next;
      if (next == 1U << size && size < 12) ++size;
    }
    if (code >= next) break;
    std::size_t const length = words[code].length;
    out.resize(out.size() + length);
    unsigned word = code;
    for (std::size_t k = 1; k <= length; ++k, word = words[word].before)
      out[out.size() - k] = static_cast<std::uint16_t>(words[word].last);
    before = code;
  }
  out.resize(std::min(out.size(), count));
  return out;
}

void place(Texels& out, std::vector<std::uint16_t> const& numbers, Palette const& palette,
           int transparent, bool interlaced) {
  auto const width = static_cast<std::size_t>(out.width),
             height = static_cast<std::size_t>(out.height);
  std::vector<std::size_t> rows;
  constexpr std::size_t starts[] = {0, 4, 2, 1}, steps[] = {8, 8, 4, 2};
  for (std::size_t pass = 0; interlaced && pass < 4; ++pass)
    for (std::size_t y = starts[pass]; y < height; y += steps[pass]) rows.push_back(y);
  out.index.resize(width * height);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    std::size_t const y = interlaced ? rows[k / width] : k / width;
    std::size_t const to = y * width + k % width, number = numbers[k];
    out.index[to] = numbers[k];
    for (std::size_t c = 0; c < 3 && 3 * number + c < palette.size(); ++c)
      out.rgba[4 * to + c] = static_cast<float>(palette[3 * number + c]) / 255;
    if (static_cast<int>(number) == transparent) out.rgba[4 * to + 3] = 0;
  }
}

} // namespace

Result<Texels> read_gif_texels(std::string_view bytes, std::string const& name) {
  Bytes in(bytes, 10);
  unsigned const flags = in.next();
  in.little16();
  Palette palette;
  if ((flags & 0x80) != 0) palette = palette_of(in, flags);
  int transparent = -1;
  while (!in.too_short()) {
    unsigned const mark = in.next();
    if (mark == 0x21) {
      bool const control = in.next() == 0xf9;
      std::string const block = blocks(in);
      if (control && block.size() >= 4 && (block[0] & 1) != 0)
        transparent = static_cast<unsigned char>(block[3]);
      continue;
    }
    if (mark != 0x2c) break;
    in.little16();
    in.little16();
    unsigned const width = in.little16(), height = in.little16(), own = in.next();
    if ((own & 0x80) != 0) palette = palette_of(in, own);
    unsigned const least = in.next();
    std::string const packed = blocks(in);
    if (in.too_short() || least < 2 || least > 8) break;
    // A code of 12 bits stands for 4096 pixels at most.
    if (static_cast<double>(width) * height > 4096.0 * static_cast<double>(packed.size()))
      return damaged_texels(name, "it is too short for its size");
    auto out = make_texels(width, height, name);
    if (!out) return out;
    std::size_t const count = std::size_t{width} * height;
    auto const numbers = unpack(packed, least, count);
    if (numbers.size() < count) break;
    out->default_gamma = -1;
    out->has_alpha = transparent >= 0;
    place(*out, numbers, palette, transparent, (own & 0x40) != 0);
    return out;
  }
  return damaged_texels(name, "it holds no whole picture");
}

} // namespace abbe::image
