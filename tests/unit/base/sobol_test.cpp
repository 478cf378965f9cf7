// SPDX-License-Identifier: MIT
#include "base/sobol.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace abbe {
namespace {

/// Asserts that of 2^k points each interval of 2^-a by 2^-(k - a) has one, for all a.
void expect_net(std::vector<std::array<double, 2>> const& points) {
  auto const count = points.size();
  for (std::size_t across = 1; across <= count; across *= 2) {
    std::size_t const down = count / across;
    std::set<std::size_t> met;
    for (auto const& [x, y] : points)
      met.insert(static_cast<std::size_t>(x * static_cast<double>(across)) * down
                 + static_cast<std::size_t>(y * static_cast<double>(down)));
    EXPECT_EQ(met.size(), count) << across << " by " << down;
  }
}

TEST(Sobol, BeginsAsItsDirectionNumbersSay) {
  // The first points in units of 1/8, by hand from the primitive polynomials.
  constexpr std::array<std::array<unsigned, 8>, 4> eighths{{{0, 4, 2, 6, 1, 5, 3, 7},
                                                            {0, 4, 6, 2, 5, 1, 3, 7},
                                                            {0, 4, 6, 2, 3, 7, 5, 1},
                                                            {0, 4, 6, 2, 1, 5, 7, 3}}};
  for (unsigned dimension = 0; dimension < 4; ++dimension)
    for (std::uint32_t i = 0; i < 8; ++i)
      EXPECT_EQ(sobol(i, dimension) >> 29, eighths[dimension][i]) << dimension << ", " << i;
}

TEST(Sobol, EveryElementaryIntervalOfTheSquareHasItsPoint) {
  for (unsigned k = 0; k <= 10; ++k)
    for (std::uint32_t const block : {0U, 1U, 5U, 1234U}) {
      std::vector<std::array<double, 2>> points;
      for (std::uint32_t i = 0; i < 1U << k; ++i) {
        std::uint32_t const index = (block << k) + i;
        points.push_back({sobol(index, 0) * 0x1p-32, sobol(index, 1) * 0x1p-32});
      }
      expect_net(points);
    }
}

TEST(Sobol, EveryDimensionIsStratifiedAndWithThePlaceToo) {
  for (unsigned dimension = 0; dimension < 4; ++dimension)
    for (unsigned k = 0; k <= 12; ++k) {
      std::set<std::uint32_t> met;
      for (std::uint32_t i = 0; i < 1U << k; ++i)
        met.insert(static_cast<std::uint32_t>(std::uint64_t{sobol(i, dimension)} >> (32 - k)));
      EXPECT_EQ(met.size(), std::size_t{1} << k);
    }
  // Dimension 2 against 0 and 1: a (1, 2)-sequence, two points in each interval of 2^(1 - k).
  for (unsigned other = 0; other < 2; ++other)
    for (unsigned a = 0; a <= 6; ++a) {
      std::vector<int> count(64);
      for (std::uint32_t i = 0; i < 128; ++i)
        ++count[((std::uint64_t{sobol(i, other)} >> (32 - a)) << (6 - a))
                | (std::uint64_t{sobol(i, 2)} >> (26 + a))];
      for (int const n : count) EXPECT_EQ(n, 2) << other << " " << a;
    }
}

TEST(OwenScrambled, EachBitHangsOnThoseAboveItAlone) {
  for (std::uint32_t seed = 1; seed < 50; ++seed)
    for (unsigned bit = 0; bit < 32; ++bit) {
      std::uint32_t const value = static_cast<std::uint32_t>(mix_bits(seed * 37 + bit));
      std::uint32_t const flipped = value ^ 1U << bit;
      std::uint32_t const seen =
          owen_scrambled(value, static_cast<std::uint32_t>(mix_bits(seed)))
          ^ owen_scrambled(flipped, static_cast<std::uint32_t>(mix_bits(seed)));
      EXPECT_EQ(std::uint64_t{seen} >> bit, 1) << "bits above change, or this one does not";
    }
}

TEST(PixelPoints, OfAPixelAndOfFourNeighboursAreNets) {
  RandomKey const picture(7);
  for (unsigned bits = 0; bits <= 6; ++bits) {
    std::vector<std::array<double, 2>> of_four;
    for (std::int64_t y = 10; y < 12; ++y)
      for (std::int64_t x = 36; x < 38; ++x) {
        PixelPoints const points(picture, x, y, bits);
        std::vector<std::array<double, 2>> own;
        for (std::uint64_t i = 0; i < 1U << bits; ++i) {
          own.push_back({points.at(i, 0), points.at(i, 1)});
          if ((i & (i + 1)) == 0) expect_net(own); // the first 2^n too
        }
        of_four.insert(of_four.end(), own.begin(), own.end());
      }
    expect_net(of_four);
  }
}

TEST(PixelPoints, WavelengthsAreStratifiedWithThePlace) {
  for (std::int64_t x = 0; x < 20; ++x) {
    PixelPoints const points(RandomKey(3), x, 5, 4);
    std::set<int> met;
    for (std::uint64_t i = 0; i < 16; ++i) met.insert(static_cast<int>(16 * points.at(i, 2)));
    EXPECT_EQ(met.size(), 16);
    // Each half of the pixel has 8 samples, and their wavelengths are in no less than 4 eighths
    // twice: an interval of 1/2 by 1/4 has two.
    for (unsigned const axis : {0U, 1U}) {
      std::array<int, 8> count{};
      for (std::uint64_t i = 0; i < 16; ++i)
        ++count[static_cast<std::size_t>(2 * points.at(i, axis)) * 4
                + static_cast<std::size_t>(4 * points.at(i, 2))];
      for (int const n : count) EXPECT_EQ(n, 2);
    }
  }
}

/// Over seeds and over pixels each number is evenly distributed: what is averaged has no bias.
TEST(PixelPoints, EachNumberIsUniform) {
  constexpr int cells = 16, draws = 16000;
  for (std::uint64_t const number : {0, 1, 13})
    for (std::uint64_t const dimension : {0, 1, 2, 3, 7, 40}) {
      std::array<std::array<int, cells>, 2> seen{};
      for (int i = 0; i < draws; ++i) {
        auto const of = [&](std::int64_t x, std::uint64_t seed) {
          return static_cast<std::size_t>(
              cells * PixelPoints(RandomKey(seed), x, 3, 4).at(number, dimension));
        };
        ++seen[0][of(11, static_cast<std::uint64_t>(i))];
        ++seen[1][of(i, 5)];
      }
      for (auto const& counts : seen) {
        double chi_squared = 0;
        constexpr double expected = double(draws) / cells;
        for (int const n : counts) chi_squared += (n - expected) * (n - expected) / expected;
        EXPECT_LT(chi_squared, 44.3) << number << " " << dimension; // 15 degrees: 1 in 10^4
      }
    }
}

/// The mean of a picture's pixels differs from pixel to pixel as blue noise does: the sum over
/// neighbours is more exact than independent numbers would be.
TEST(PixelPoints, ErrorsOfNeighboursCancel) {
  double own = 0, of_sixteen = 0;
  constexpr int blocks = 24, n = 4;
  auto const error = [](std::int64_t x, std::int64_t y) {
    PixelPoints const points(RandomKey(1), x, y, 2);
    double sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) // the integral of x^2 + y is 5/6
      sum += points.at(i, 0) * points.at(i, 0) + points.at(i, 1);
    return sum / n - 5.0 / 6;
  };
  for (std::int64_t by = 0; by < blocks; ++by)
    for (std::int64_t bx = 0; bx < blocks; ++bx) {
      double sum = 0;
      for (std::int64_t y = 0; y < 4; ++y)
        for (std::int64_t x = 0; x < 4; ++x) {
          double const e = error(4 * bx + x, 4 * by + y);
          own += e * e / (16.0 * blocks * blocks);
          sum += e / 16;
        }
      of_sixteen += sum * sum / (blocks * blocks);
    }
  EXPECT_LT(of_sixteen, own / 16 / 10); // independent: a sixteenth of the variance
}

TEST(PixelPoints, ManySamplesLeaveLessRoomForPixels) {
  PixelPoints const a(RandomKey(2), 1 << 20, -5, 24), b(RandomKey(2), (1 << 20) + 16, -5, 24);
  EXPECT_NE(a.at(0, 0), b.at(0, 0));
  EXPECT_EQ(a.at(123456, 1), PixelPoints(RandomKey(2), 1 << 20, -5, 24).at(123456, 1));
}

} // namespace
} // namespace abbe
