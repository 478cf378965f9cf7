// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace abbe {

/// Counter-based random numbers: a number is a pure function of what it is for, so that threads,
/// tiles and order do not matter (law 2). Keys chain: child = combine(parent, index).
/// The mixer is the 64-bit finaliser of SplitMix64 (Steele, Lea, Flood 2014), variant 13 of
/// Stafford.
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ULL;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebULL;
  v ^= v >> 31;
  return v;
}

class RandomKey {
public:
  constexpr explicit RandomKey(std::uint64_t seed = 0) : bits_(mix_bits(seed + golden)) {}

  /// The key of a child: a pixel of an image, a sample of a pixel, a branch of a path.
  constexpr RandomKey child(std::uint64_t index) const {
    RandomKey key;
    key.bits_ = mix_bits(bits_ + golden * (index + 1));
    return key;
  }
  /// Uniform in [0, 1), 53 bits, for one dimension of this key.
  constexpr double uniform(std::uint64_t dimension) const {
    return static_cast<double>(child(dimension).bits_ >> 11) * 0x1p-53;
  }
  constexpr std::uint64_t bits() const { return bits_; }

private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  std::uint64_t bits_ = 0;
};

} // namespace abbe
