// SPDX-License-Identifier: MIT
#include "texture/noise_tables.hpp"

#include "base/result.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <random>
#include <utility>

namespace abbe::texture {
namespace {

/// CRC-16 with the reflected polynomial 0xA001, start 0.
std::uint32_t crc16_step(std::uint32_t crc, std::uint32_t byte) {
  crc ^= byte;
  for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0xA001u : crc >> 1;
  return crc;
}

/// Of the 24 bytes of three copies of `value`, most significant byte first.
std::uint32_t crc16_of_triple(double value) {
  auto const bits = std::bit_cast<std::uint64_t>(value);
  std::uint32_t crc = 0;
  for (int copy = 0; copy < 3; ++copy)
    for (int shift = 56; shift >= 0; shift -= 8)
      crc = crc16_step(crc, static_cast<std::uint32_t>(bits >> shift) & 0xff);
  return crc;
}

/// POV-Ray's table was printed with six significant digits; so its numbers are these.
/// Through charconv, which no locale can change.
double six_digits(double value) {
  char text[32];
  auto const written =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  double rounded = 0;
  auto const read = std::from_chars(text, written.ptr, rounded);
  ABBE_ASSERT(read.ec == std::errc{});
  return rounded;
}

} // namespace

NoiseTables::NoiseTables() : gradient{}, hash{} {
  for (std::size_t i = 0; i < gradient.size(); ++i)
    gradient[i] = six_digits(crc16_of_triple(static_cast<double>(i) * 0.12345) * 2 / 65535.0 - 1);

  for (std::size_t i = 0; i < 4096; ++i) hash[i] = static_cast<std::uint16_t>(i);
  std::uint32_t state = 0;
  for (std::size_t i = 4096; i-- > 0;) {
    state = lcg(state);
    std::swap(hash[i], hash[lcg_high(state) & 4095]);
  }
  for (std::size_t i = 0; i < 4096; ++i) hash[4096 + i] = hash[i];
}

GradientNoiseTables::GradientNoiseTables() : gradient{}, permutation{} {
  std::uint32_t state = 1;
  auto const next = [&state] {
    state = lcg(state);
    return (static_cast<double>(lcg_high(state) & 4095) - 2048) / 2048;
  };
  for (std::size_t i = 0; i < 2048; ++i) {
    Vec3 v{0};
    double square = 0;
    do {
      v.x = next();
      v.y = next();
      v.z = next();
      square = glm::dot(v, v);
    } while (square > 1 || square < 1e-5);
    gradient[i] = gradient[2048 + i] = v / std::sqrt(square);
  }

  // Entry 2048 is 0 at first and takes part in the swaps, so that this is not quite a permutation.
  for (std::size_t i = 0; i < 2048; ++i) permutation[i] = static_cast<std::uint16_t>(i);
  for (std::size_t i = 2048; i >= 2; i -= 2) {
    state = lcg(state);
    std::swap(permutation[i], permutation[lcg_high(state) & 2047]);
  }
  for (std::size_t i = 0; i < 2048; ++i) permutation[2048 + i] = permutation[i];
}

CellRandoms::CellRandoms() : value{} {
  std::mt19937 generator(5489);
  for (double& v : value) v = static_cast<double>(generator()) * 0x1p-32;
}

NoiseTables const& noise_tables() {
  static NoiseTables const tables;
  return tables;
}

GradientNoiseTables const& gradient_noise_tables() {
  static GradientNoiseTables const tables;
  return tables;
}

CellRandoms const& cell_randoms() {
  static CellRandoms const randoms;
  return randoms;
}

} // namespace abbe::texture
