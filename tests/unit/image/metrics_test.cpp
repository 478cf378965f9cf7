// SPDX-License-Identifier: MIT
#include "image/metrics.hpp"

#include "image/colour.hpp"
#include "image/flip.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <limits>

namespace abbe::image {
namespace {

Image uniform(int width, int height, Vec3 rgb) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels(); ++i) set_pixel(image, i, rgb);
  return image;
}

TEST(Metrics, EqualImagesHaveNoDifference) {
  Image const image = gradient(20, 10);
  Result<Metrics> const m = compare(image, image);
  ASSERT_TRUE(m.ok());
  EXPECT_EQ(m->rmse_linear, 0);
  EXPECT_EQ(m->rmse_srgb, 0);
  EXPECT_TRUE(std::isinf(m->psnr_linear_db) && std::isinf(m->psnr_srgb_db));
  EXPECT_EQ(m->relative_mse, 0);
  EXPECT_EQ(m->relative_mse_xyz, 0);
  EXPECT_EQ(m->delta_e_mean, 0);
  EXPECT_EQ(m->delta_e_max, 0);
  EXPECT_EQ(m->flip_max, 0);
  EXPECT_EQ(m->differing_share, 0);
}

TEST(Metrics, ConstantOffsetByHand) {
  Result<Metrics> const m = compare(uniform(8, 8, Vec3(0.5)), uniform(8, 8, Vec3(0.25)));
  ASSERT_TRUE(m.ok());
  EXPECT_EQ(m->rmse_linear, 0.25);
  EXPECT_NEAR(m->psnr_linear_db, 12.0412, 5e-5); // 20 log10 4
  EXPECT_EQ(m->max_linear, 0.25);
  EXPECT_NEAR(m->relative_mse, 0.0625 / (0.25 + 0.01 * 0.25), 1e-15);
  EXPECT_NEAR(m->relative_mse_xyz,
              (0.0625 * 0.9505 * 0.9505 / (0.25 * 0.9505 * 0.9505 + 0.01 * 0.25)
               + 0.0625 / (0.25 + 0.01 * 0.25)
               + 0.0625 * 1.089 * 1.089 / (0.25 * 1.089 * 1.089 + 0.01 * 0.25))
                  / 3,
              1e-6);                  // X, Y, Z of white: 0.9505, 1, 1.089
  EXPECT_EQ(m->max_codes, 188 - 137); // codes of 0.5 and 0.25
  EXPECT_NEAR(m->psnr_srgb_db, 20 * std::log10(255.0 / 51), 1e-12);
  EXPECT_NEAR(m->rmse_srgb, 0.735357 - 0.537099, 2e-6);
  EXPECT_EQ(m->differing_share, 1);
}

TEST(Metrics, ThresholdAndPercentilesCountPixels) {
  Image const reference = uniform(10, 10, Vec3(0.5));
  Image test = reference;
  for (std::size_t i = 0; i < 4; ++i) set_pixel(test, i, Vec3(srgb_decode(190.0 / 255))); // 2 codes
  set_pixel(test, 50, Vec3(0));
  EXPECT_EQ(compare(reference, test)->differing_share, 0.05);
  EXPECT_EQ(compare(reference, test, {.threshold_codes = 2})->differing_share, 0.01);
  Metrics const m = *compare(reference, test);
  EXPECT_EQ(m.delta_e_p95, 0); // 95 of 100 do not differ
  EXPECT_GT(m.delta_e_p99, 0.2);
  EXPECT_LT(m.delta_e_p99, 1);
  EXPECT_GT(m.delta_e_max, 60);
  EXPECT_EQ(m.delta_e_share_above_1, 0.01);
  EXPECT_EQ(m.max_codes, 188);
}

TEST(Metrics, DeltaEOfGreysMatchesTheFormulaByHand) {
  // Greys of L* 50 and 51: CIEDE2000 = 1 / S_L at 50.5 = 1 / (1 + 0.015 * 0.25 / sqrt(20.25)).
  auto const grey = [](double lightness) {
    return uniform(4, 4, Vec3(lab_to_xyz({lightness, 0, 0}).y));
  };
  Metrics const m = *compare(grey(50), grey(51));
  EXPECT_NEAR(m.delta_e_mean, 1 / (1 + 0.015 * 0.25 / 4.5), 1e-5); // images hold floats
}

TEST(Metrics, DifferentSizesAreAnError) {
  Result<Metrics> const m = compare(gradient(4, 5), gradient(5, 4));
  ASSERT_FALSE(m.ok());
  EXPECT_EQ(m.error().message, "the images differ in size: 4 x 5 and 5 x 4 pixels");
  EXPECT_FALSE(difference_image(gradient(4, 5), gradient(5, 4)).ok());
}

TEST(Metrics, NanIsCountedAndInfinityEqualsInfinity) {
  Image reference = uniform(4, 4, Vec3(0.5));
  Image test = reference;
  reference.rgb[0] = test.rgb[0] = std::numeric_limits<float>::infinity();
  test.rgb[5] = std::numeric_limits<float>::quiet_NaN();
  Metrics const m = *compare(reference, test);
  EXPECT_EQ(m.not_a_number, 1U);
  EXPECT_EQ(m.max_linear, 0.5);
}

TEST(Metrics, DifferenceImageHoldsEncodedDifferences) {
  Image const d = *difference_image(uniform(2, 2, Vec3(0.5)), uniform(2, 2, Vec3(0.25)), 2);
  EXPECT_NEAR(srgb_encode(d.rgb[0]), 2 * (0.735357 - 0.537099), 4e-6);
}

// Flip. Uniform images have no features and filters leave them alone: the result is closed form.

double flip_of_uniform(Vec3 one, Vec3 two) {
  return flip(uniform(12, 9, one), uniform(12, 9, two))[40];
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  EXPECT_NEAR(flip_of_uniform({0, 1, 0}, {0, 0, 1}), 1, 1e-6); // by the definition of the scale
}

TEST(Flip, GreysByHand) {
  // HyAB of black and white is 100. Green and blue, Hunt-adjusted, from Lindbloom's L*a*b* of the
  // sRGB primaries (87.7347, -86.1827, 83.1793; 32.2970, 79.1875, -107.8602):
  // |87.7347 - 32.2970| + |0.877347 (-86.1827, 83.1793) - 0.322970 (79.1875, -107.8602)| = 203.297.
  // His white is another D65 in the fourth digit, hence 1e-3.
  double const largest = std::pow(203.297, 0.7);
  double const limit = 0.4 * largest;
  double const white = std::pow(100.0, 0.7);
  double const expected =
      white < limit ? 0.95 * white / limit : 0.95 + 0.05 * (white - limit) / (largest - limit);
  EXPECT_NEAR(flip_of_uniform(Vec3(0), Vec3(1)), expected, 1e-3);
  double const small = std::pow(10.0, 0.7) * 0.95 / limit; // L* 50 and 60
  EXPECT_NEAR(flip_of_uniform(Vec3(lab_to_xyz({50, 0, 0}).y), Vec3(lab_to_xyz({60, 0, 0}).y)),
              small, 1e-3);
}

TEST(Flip, SymmetricAndZeroForEqualImages) {
  Image const one = gradient(40, 30);
  Image two = one;
  for (std::size_t i = 300; i < 600; ++i) set_pixel(two, i, Vec3(0.3, 0.9, 0.1));
  EXPECT_EQ(flip(one, two), flip(two, one));
  for (float const error : flip(one, one)) EXPECT_EQ(error, 0);
}

TEST(Flip, APointIsSeenWhereItIsAndNotFarAway) {
  Image const black = uniform(81, 61, Vec3(0));
  Image point = black;
  set_pixel(point, 30 * 81 + 40, Vec3(1));
  std::vector<float> const errors = flip(black, point);
  EXPECT_GT(errors[30 * 81 + 40], 0.2);
  EXPECT_EQ(errors[5 * 81 + 5], 0); // beyond the radius of every filter
  for (float const error : errors) EXPECT_TRUE(error >= 0 && error <= 1);
  // The filters are symmetric.
  EXPECT_EQ(errors[30 * 81 + 37], errors[30 * 81 + 43]);
  EXPECT_NEAR(errors[27 * 81 + 40], errors[30 * 81 + 37], 1e-6);
}

TEST(Flip, TranslationMovesTheErrors) {
  auto const with_square = [](int x0) {
    Image image = uniform(90, 60, Vec3(0.2, 0.3, 0.4));
    for (int y = 25; y < 33; ++y)
      for (int x = x0; x < x0 + 8; ++x)
        set_pixel(image, static_cast<std::size_t>(y * 90 + x), {0.9, 0.2, 0.1});
    return image;
  };
  Image const plain = uniform(90, 60, Vec3(0.2, 0.3, 0.4));
  std::vector<float> const one = flip(plain, with_square(30));
  std::vector<float> const two = flip(plain, with_square(41));
  for (std::size_t y = 0; y < 60; ++y)
    for (std::size_t x = 12; x < 70; ++x) EXPECT_EQ(one[y * 90 + x], two[y * 90 + x + 11]);
}

/// The achromatic filter and the detectors as the paper prints them, in two dimensions, at one
/// pixel.
struct Direct {
  Image const& image;
  int x, y;
  double ppd = flip_pixels_per_degree;

  template <class Weight>
  double sum(int radius, Weight const& weight, bool halves) const {
    double positive = 0, negative = 0, up = 0, down = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx) {
        double const w = weight(dx, dy);
        double const v = image.rgb[3 * static_cast<std::size_t>((y + dy) * image.width + x + dx)];
        (w > 0 ? positive : negative) += w;
        (w > 0 ? up : down) += w * v;
      }
    return halves ? up / positive + down / -negative : (up + down) / (positive + negative);
  }
  double seen() const {
    double const b = 0.0047;
    return sum(
        10,
        [&](int dx, int dy) {
          return std::exp(-9.8696044 * (dx * dx + dy * dy) / (ppd * ppd * b));
        },
        false);
  }
  double feature(int order) const {
    double const sd = 0.041 * ppd;
    auto const g = [&](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2 * sd * sd)); };
    auto const along = [&](int d) { return order == 1 ? -d : d * d / (sd * sd) - 1; };
    double const fx = sum(
        9, [&](int dx, int dy) { return along(dx) * g(dx, dy); }, true);
    double const fy = sum(
        9, [&](int dx, int dy) { return along(dy) * g(dx, dy); }, true);
    return std::hypot(fx, fy);
  }
};

TEST(Flip, GreyImagesMatchTheDirectEvaluationOfThePaper) {
  Image one = make_image(31, 31);
  Image two = make_image(31, 31);
  std::uint32_t bits = 7;
  for (std::size_t i = 0; i < one.pixels(); ++i) {
    bits = bits * 1664525U + 1013904223U;
    set_pixel(one, i, Vec3((bits >> 8) * 0x1p-24));
    set_pixel(two, i, Vec3(0.5 + 0.02 * static_cast<double>(i % 31) - 0.3 * (i > 500)));
  }
  std::vector<float> const errors = flip(one, two);
  double const largest = std::pow(203.297, 0.7); // see GreysByHand
  for (int y = 12; y < 19; ++y)
    for (int x = 12; x < 19; ++x) {
      Direct const a{one, x, y};
      Direct const b{two, x, y};
      auto const lightness = [](double v) {
        return xyz_to_lab(linear_srgb_to_xyz(Vec3(std::min(v, 1.0)))).x;
      };
      double const apart = std::pow(std::abs(lightness(a.seen()) - lightness(b.seen())), 0.7);
      double const limit = 0.4 * largest;
      double const colour =
          apart < limit ? 0.95 * apart / limit : 0.95 + 0.05 * (apart - limit) / (largest - limit);
      double const strongest =
          std::max(std::abs(a.feature(1) - b.feature(1)), std::abs(a.feature(2) - b.feature(2)));
      double const expected = std::pow(colour, 1 - std::sqrt(strongest / std::sqrt(2.0)));
      EXPECT_NEAR(errors[static_cast<std::size_t>(y * 31 + x)], expected, 1e-3) << x << ' ' << y;
    }
}

/// What the eye sees at one pixel: the filters of table 1 of the paper in two dimensions.
Vec3 directly_seen(Image const& image, int x, int y) {
  double const csf[3][4] = {{1, 0.0047, 0, 1}, {1, 0.0053, 0, 1}, {34.1, 0.04, 13.5, 0.025}};
  double const ppd = flip_pixels_per_degree;
  double const pi = 3.14159265358979;
  Vec3 const white = linear_srgb_to_xyz(Vec3(1));
  Vec3 sum(0);
  Vec3 weights(0);
  for (int dy = -10; dy <= 10; ++dy)
    for (int dx = -10; dx <= 10; ++dx) {
      auto const place = static_cast<std::size_t>((y + dy) * image.width + x + dx);
      Vec3 const t = linear_srgb_to_xyz(pixel(image, place)) / white;
      Vec3 const opponent(t.y, t.x - t.y, t.y - t.z);
      double const r2 = (dx * dx + dy * dy) / (ppd * ppd);
      for (int c = 0; c < 3; ++c) {
        double const* k = csf[c];
        double const w = k[0] * std::sqrt(pi / k[1]) * std::exp(-pi * pi * r2 / k[1])
                         + k[2] * std::sqrt(pi / k[3]) * std::exp(-pi * pi * r2 / k[3]);
        sum[c] += w * opponent[c];
        weights[c] += w;
      }
    }
  sum = sum / weights;
  Vec3 const lab = xyz_to_lab(white * Vec3(sum.x + sum.y, sum.x, sum.x - sum.z));
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

TEST(Flip, ColoursWithoutFeaturesMatchTheDirectEvaluationOfThePaper) {
  // Equal luminance everywhere in both: no edges, no points. Hues vary, inside the cube of sRGB.
  auto const noise = [](std::uint32_t bits) {
    Image image = make_image(27, 27);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      double value[2];
      for (double& v : value) {
        bits = bits * 1664525U + 1013904223U;
        v = 0.2 + 0.3 * (bits >> 8) * 0x1p-24;
      }
      // green that makes luminance 0.35 with these red and blue
      double const rest = 0.35 - luminance({value[0], 0, value[1]});
      set_pixel(image, i, {value[0], rest / luminance({0, 1, 0}), value[1]});
    }
    return image;
  };
  Image const one = noise(3);
  Image const two = noise(99);
  std::vector<float> const errors = flip(one, two);
  double const limit = 0.4 * std::pow(203.297, 0.7); // see GreysByHand
  for (int y = 11; y < 16; ++y)
    for (int x = 11; x < 16; ++x) {
      Vec3 const d = directly_seen(one, x, y) - directly_seen(two, x, y);
      double const apart = std::abs(d.x) + std::hypot(d.y, d.z);
      double const colour = 0.95 * std::pow(apart, 0.7) / limit;
      // Images hold floats: luminances differ by 1e-7, which is a feature of sqrt(1e-7) and moves
      // the exponent by 3e-4.
      EXPECT_NEAR(errors[static_cast<std::size_t>(y * 27 + x)], colour, 5e-3 * colour)
          << x << ' ' << y;
    }
}

} // namespace
} // namespace abbe::image
