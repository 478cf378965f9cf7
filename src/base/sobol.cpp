// SPDX-License-Identifier: MIT
#include "base/sobol.hpp"

#include <algorithm>
#include <array>

namespace abbe {
namespace {

constexpr unsigned dimensions = 4;

/// A primitive polynomial x^degree + ... + 1, its inner coefficients as bits, and the first odd
/// numbers of the recurrence.
struct Polynomial {
  unsigned degree, inner;
  std::array<std::uint32_t, 3> first;
};
/// These make dimensions 1 to 3; dimension 0 is van der Corput's sequence.
constexpr std::array<Polynomial, dimensions - 1> polynomials{
    {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};

/// Each bit of an index adds one of these (exclusive or).
using Columns = std::array<std::uint32_t, 32>;

constexpr Columns columns_of(unsigned dimension) {
  Columns v{};
  for (unsigned j = 0; j < 32; ++j) v[j] = 1U << (31 - j);
  if (dimension == 0) return v;
  auto const& [degree, inner, first] = polynomials[dimension - 1];
  for (unsigned j = 0; j < 32; ++j) {
    if (j < degree) {
      v[j] = first[j] << (31 - j);
      continue;
    }
    v[j] = v[j - degree] ^ (v[j - degree] >> degree);
    for (unsigned k = 1; k < degree; ++k)
      if (inner >> (degree - 1 - k) & 1) v[j] ^= v[j - k];
  }
  return v;
}

/// By byte of the index and its value.
using Table = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr Table table_of(unsigned dimension) {
  Table table{};
  Columns const columns = columns_of(dimension);
  for (unsigned byte = 0; byte < 4; ++byte)
    for (unsigned value = 1; value < 256; ++value) {
      unsigned low = 0;
      while ((value >> low & 1) == 0) ++low;
      table[byte][value] = table[byte][value & (value - 1)] ^ columns[8 * byte + low];
    }
  return table;
}
constexpr std::array<Table, dimensions> tables{table_of(0), table_of(1), table_of(2), table_of(3)};

constexpr std::uint32_t reversed(std::uint32_t v) {
  v = (v >> 1 & 0x55555555U) | (v & 0x55555555U) << 1;
  v = (v >> 2 & 0x33333333U) | (v & 0x33333333U) << 2;
  v = (v >> 4 & 0x0f0f0f0fU) | (v & 0x0f0f0f0fU) << 4;
  return __builtin_bswap32(v);
}

/// Bits of the low half at even places.
constexpr std::uint32_t spread(std::uint32_t v) {
  v &= 0xffffU;
  v = (v | v << 8) & 0x00ff00ffU;
  v = (v | v << 4) & 0x0f0f0f0fU;
  v = (v | v << 2) & 0x33333333U;
  return (v | v << 1) & 0x55555555U;
}

std::uint32_t seed_of(RandomKey key) {
  return static_cast<std::uint32_t>(key.bits() >> 32);
}

} // namespace

std::uint32_t sobol(std::uint32_t index, unsigned dimension) {
  Table const& table = tables[dimension];
  return table[0][index & 0xff] ^ table[1][index >> 8 & 0xff] ^ table[2][index >> 16 & 0xff]
         ^ table[3][index >> 24];
}

std::uint32_t owen_scrambled(std::uint32_t bits, std::uint32_t seed) {
  std::uint32_t v = reversed(bits);
  v ^= v * 0x3d20adeaU;
  v += seed;
  v *= seed >> 16 | 1;
  v ^= v * 0x05526c56U;
  v ^= v * 0x53a22864U;
  return reversed(v);
}

PixelPoints::PixelPoints(RandomKey picture, std::int64_t x, std::int64_t y, unsigned bits) {
  unsigned const across = std::min(16U, (32 - bits) / 2); // bits of a coordinate within a block
  block_ = picture.child(static_cast<std::uint64_t>(y >> across))
               .child(static_cast<std::uint64_t>(x >> across));
  auto const within = [&](std::int64_t v) {
    return static_cast<std::uint32_t>(v & ((std::int64_t{1} << across) - 1));
  };
  std::uint32_t const place = spread(within(x)) | spread(within(y)) << 1;
  first_ = bits < 32 ? place << bits : 0;
}

double PixelPoints::at(std::uint64_t number, std::uint64_t dimension) const {
  RandomKey const group = block_.child(dimension / dimensions);
  auto const index = owen_scrambled(first_ + static_cast<std::uint32_t>(number), seed_of(group));
  auto const within = static_cast<unsigned>(dimension % dimensions);
  return owen_scrambled(sobol(index, within), seed_of(group.child(within))) * 0x1p-32;
}

} // namespace abbe
