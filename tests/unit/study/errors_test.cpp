// SPDX-License-Identifier: MIT
#include "study/errors.hpp"

#include "base/random.hpp"
#include "image/colour.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::study {
namespace {

image::Image grey(int width, int height, double value) {
  auto picture = image::make_image(width, height);
  for (auto& v : picture.rgb) v = static_cast<float>(value);
  return picture;
}

/// A spectrum drawn out from left to right, the same in each row.
image::Image spectrum(int width, int height, int bands) {
  auto picture = image::make_image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double t = (x + 0.5) / width;
      if (bands > 0) t = (std::floor(t * bands) + 0.5) / bands;
      image::set_pixel(picture, static_cast<std::size_t>(y * width + x),
                       {0.5 + 0.3 * std::cos(3 * t), 0.5, 0.5 - 0.3 * std::cos(3 * t)});
    }
  return picture;
}

TEST(RelativeMse, OfAGreyThatIsATenthTooBright) {
  // Each of X, Y and Z is 10 % too large: 0.01 R^2 / (R^2 + 0.01 m^2), and R = m for Y only.
  auto const reference = grey(4, 4, 0.5), test = grey(4, 4, 0.55);
  Vec3 const r = image::linear_srgb_to_xyz({0.5, 0.5, 0.5});
  double expected = 0;
  for (int c = 0; c < 3; ++c) expected += 0.01 * r[c] * r[c] / (r[c] * r[c] + 0.01 * r.y * r.y) / 3;
  auto const errors = measure_errors(reference, test, dispersion_field(reference));
  EXPECT_NEAR(errors.relative_mse, expected, 1e-7); // floats
}

TEST(Spread, SplitsTheErrorIntoNoiseAndBias) {
  // Two pictures at 0.5 + 0.1 -+ 0.05: in each pixel variance 0.005 (n - 1), bias 0.1; what the
  // noise leaves in the mean of two, 0.0025, is taken off its square.
  auto const reference = grey(4, 4, 0.5);
  std::vector<image::Image> const tests{grey(4, 4, 0.55), grey(4, 4, 0.65)};
  auto const spread = measure_spread(reference, tests, false);
  ASSERT_TRUE(spread);
  EXPECT_NEAR(spread->bias / spread->noise, std::sqrt((0.01 - 0.0025) / 0.005), 1e-6);
}

TEST(Spread, OfOneNoisyPictureIsUnknown) {
  auto const reference = grey(4, 4, 0.5);
  std::vector<image::Image> const one{grey(4, 4, 0.6)};
  EXPECT_FALSE(measure_spread(reference, one, false));
  auto const spread = measure_spread(reference, one, true);
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->noise, 0);
  EXPECT_GT(spread->bias, 0);
}

TEST(DispersionField, FollowsTheColours) {
  auto const field = dispersion_field(spectrum(32, 16, 0));
  std::size_t const middle = 8 * 32 + 16;
  EXPECT_NEAR(std::abs(field.dx[middle]), 1, 1e-6);
  EXPECT_GT(field.weight[middle], 0);
}

TEST(Banding, FallsWithTheNumberOfBands) {
  auto const reference = spectrum(96, 16, 0);
  auto const field = dispersion_field(reference);
  EXPECT_EQ(banding(reference, reference, field), 0);
  double const four = banding(reference, spectrum(96, 16, 4), field);
  double const eight = banding(reference, spectrum(96, 16, 8), field);
  EXPECT_GT(four, 1.2 * eight);
  EXPECT_GT(eight, 0);
}

TEST(Banding, IsBlindToNoise) {
  auto const reference = spectrum(96, 64, 0);
  auto noisy = reference;
  for (std::size_t i = 0; i < noisy.rgb.size(); ++i)
    noisy.rgb[i] += static_cast<float>(0.05 * (RandomKey(7).uniform(i) - 0.5));
  auto const field = dispersion_field(reference);
  // The energies along and across differ by chance only: by some 1/sqrt(6144 pixels) of either.
  EXPECT_LT(banding(reference, noisy, field), 0.5 * banding(reference, spectrum(96, 64, 4), field));
}

TEST(DeltaEMap, IsZeroWhereNothingDiffers) {
  auto const a = spectrum(8, 4, 0);
  EXPECT_EQ(mean(delta_e_map(a, a)), 0);
}

} // namespace
} // namespace abbe::study
