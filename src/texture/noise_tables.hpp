// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <array>
#include <cstdint>

/// The tables behind noise, cells and crackle, computed from their definitions (section 9.1 of the
/// language notes) when first asked for, once a process. Immutable afterwards.
namespace abbe::texture {

/// POV-Ray's linear congruential generator, modulo 2^32.
constexpr std::uint32_t lcg(std::uint32_t state) {
  return state * 1812433253u + 12345u;
}
/// Bits 16..30 of its state: 0..32767.
constexpr std::uint32_t lcg_high(std::uint32_t state) {
  return (state >> 16) & 0x7fff;
}

/// Generators 1 and 2, and the cell hash.
struct NoiseTables {
  std::array<double, 267> gradient;     ///< G
  std::array<std::uint16_t, 8192> hash; ///< H: a permutation of 0..4095, twice
  NoiseTables();

  /// h3 of three cell coordinates, each already & 4095: 0..4095.
  int cell_hash(int a, int b, int c) const { return hash[hash[hash[a] ^ b] ^ c]; }
};
NoiseTables const& noise_tables();

/// Generator 3.
struct GradientNoiseTables {
  std::array<Vec3, 4096> gradient;
  std::array<std::uint16_t, 4096> permutation;
  GradientNoiseTables();
};
GradientNoiseTables const& gradient_noise_tables();

/// Uniform in [0, 1): R[i] for every i that a cell hash + 0..2 can reach.
struct CellRandoms {
  std::array<double, 4098> value;
  CellRandoms();
};
CellRandoms const& cell_randoms();

} // namespace abbe::texture
