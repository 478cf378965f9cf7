// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"

#include <cstdint>

namespace abbe {

/// Four dimensions of the Sobol sequence: the first 2^k points, and any aligned 2^k of them, have
/// one point in each of 2^k equal intervals of any dimension; in the first two, one in each
/// elementary interval (2^-a by 2^-(k-a)) of the square.
/// @param dimension 0 to 3
/// @return in units of 2^-32
/// @source S. Joe, F. Kuo, Constructing Sobol sequences with better two-dimensional projections,
///         SIAM J. Sci. Comput. 30, 2008: primitive polynomials and initial numbers
std::uint32_t sobol(std::uint32_t index, unsigned dimension);

/// Owen's scrambling by a hash: each bit is flipped or not by what the bits above it are, so that
/// elementary intervals change places and points within them do too.
/// @source B. Burley, Practical hash-based Owen scrambling, JCGT 9(4), 2020, after S. Laine and
///         T. Karras, Stratified sampling for stochastic transparency, EGSR 2011; constants: N.
///         Vegdahl, Building a better LK hash, 2021
std::uint32_t owen_scrambled(std::uint32_t bits, std::uint32_t seed);

/// The points of a picture's samples: one scrambled Sobol sequence, of which each pixel has a part
/// of 2^bits points, along a Morton curve. Parts of neighbours complete each other, so that what
/// errors are left differ from pixel to pixel: they look like blue noise. The order of parts of a
/// part is random, of halves of halves: the first points of a pixel are as even as all.
/// @source A. G. M. Ahmed, P. Wonka, Screen-space blue-noise diffusion of Monte Carlo sampling
///         error via hierarchical ordering of pixels, ACM TOG 39(6), 2020
class PixelPoints {
public:
  PixelPoints() = default;
  /// @param picture of all its pixels @param bits 0 to 24: room for 2^bits samples of a pixel
  PixelPoints(RandomKey picture, std::int64_t x, std::int64_t y, unsigned bits);

  /// @param number of the sample, below 2^bits
  /// @param dimension those from 4k to 4k + 3 are stratified together
  /// @return in [0, 1)
  double at(std::uint64_t number, std::uint64_t dimension) const;

private:
  RandomKey block_; ///< of as many pixels as an index of 32 bits has room for
  std::uint32_t first_ = 0;
};

} // namespace abbe
