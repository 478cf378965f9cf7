// SPDX-License-Identifier: MIT
#include "image/tone_map.hpp"

#include "image/colour.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abbe::image {
namespace {

/// CIE 1931 colour matching functions as Gaussians: Wyman, Sloan, Shirley, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013. The stimuli only
/// have to be spectral colours far outside sRGB; the fit is within 1 % of the peaks.
Vec3 monochromatic_xyz(double nm) {
  auto const lobe = [nm](double height, double centre, double below, double above) {
    double const t = (nm - centre) * (nm < centre ? below : above);
    return height * std::exp(-0.5 * t * t);
  };
  return {lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323)
              + lobe(-0.065, 501.1, 0.0490, 0.0382),
          lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
          lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)};
}

double hue_deg(Vec3 rgb) {
  Vec2 const from_white =
      xyz_to_uv(linear_srgb_to_xyz(rgb)) - xyz_to_uv(linear_srgb_to_xyz(Vec3(1)));
  return std::atan2(from_white.y, from_white.x) * 57.29577951308232;
}

TEST(ToneMap, EveryMonochromaticStimulusKeepsHueAndLuminanceInGamut) {
  for (Gamut const gamut : {Gamut::Standard, Gamut::Hue}) {
    for (int nm = 380; nm <= 780; ++nm) {
      for (double const level : {1e-3, 0.02, 0.2, 1.0, 30.0}) {
        Vec3 const rgb = level * xyz_to_linear_srgb(monochromatic_xyz(nm));
        ASSERT_LT(std::min({rgb.x, rgb.y, rgb.z}), 0) << nm; // out of gamut, every one of them
        Vec3 const mapped = map_to_gamut(rgb, gamut);
        double top = 0;
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(mapped[c], 0) << nm;
          ASSERT_LE(mapped[c], 1) << nm;
          top = std::max(top, mapped[c]);
        }
        if (gamut == Gamut::Standard && top == 1) continue; // clipped, as POV-Ray does
        // The line to white in u'v' is kept exactly; the demand is 2 degrees.
        EXPECT_NEAR(std::remainder(hue_deg(mapped) - hue_deg(rgb), 360), 0, 1e-6) << nm;
        double const y = luminance(rgb);
        EXPECT_LE(luminance(mapped), y * (1 + 1e-12)) << nm;
        // Where the display can show that luminance in that hue, it does; sums of three products.
        if (top < 1) {
          EXPECT_NEAR(luminance(mapped), y, 1e-14 * (std::abs(rgb.x) + rgb.y + 1)) << nm;
        }
      }
    }
  }
}

TEST(ToneMap, ColoursInGamutAreUntouchedInEveryMode) {
  for (Gamut const gamut : {Gamut::Clip, Gamut::Standard, Gamut::Hue})
    for (double r = 0; r <= 1; r += 0.125)
      for (double g = 0; g <= 1; g += 0.125)
        for (double b = 0; b <= 1; b += 0.125)
          EXPECT_EQ(map_to_gamut({r, g, b}, gamut), Vec3(r, g, b));
}

TEST(ToneMap, OverRangeClipsPerChannelByDefaultAndKeepsHueOnRequest) {
  EXPECT_EQ(map_to_gamut({4, 1, 0.5}, Gamut::Standard), Vec3(1, 1, 0.5));
  EXPECT_EQ(map_to_gamut({4, 1, 0.5}, Gamut::Clip), Vec3(1, 1, 0.5));
  EXPECT_EQ(map_to_gamut({4, 1, 0.5}, Gamut::Hue), Vec3(1, 0.25, 0.125));
  EXPECT_EQ(map_to_gamut({-1, 2, 0.5}, Gamut::Clip), Vec3(0, 1, 0.5));
  EXPECT_EQ(ToneOptions{}.gamut, Gamut::Standard);
}

TEST(ToneMap, LuminanceNotAboveZeroIsBlack) {
  for (Gamut const gamut : {Gamut::Standard, Gamut::Hue}) {
    EXPECT_EQ(map_to_gamut({-1, 0, 0}, gamut), Vec3(0));
    EXPECT_EQ(map_to_gamut({0.1, -1, 0.3}, gamut), Vec3(0));
    EXPECT_EQ(map_to_gamut({0, 0, 0}, gamut), Vec3(0));
  }
}

TEST(ToneMap, NoInputBreaksIt) {
  double const values[] = {0.0,
                           -0.0,
                           1.0,
                           -1e-300,
                           1e300,
                           -1e300,
                           5e-324,
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};
  for (Gamut const gamut : {Gamut::Clip, Gamut::Standard, Gamut::Hue})
    for (double const r : values)
      for (double const g : values)
        for (double const b : values) {
          Vec3 const mapped = map_to_gamut({r, g, b}, gamut);
          for (int c = 0; c < 3; ++c) EXPECT_TRUE(mapped[c] >= 0 && mapped[c] <= 1);
        }
}

TEST(ToneMap, ExposureAndReport) {
  Image image = make_image(4, 1);
  image.rgb = {0.25F, 0.25F, 0.25F, -0.1F, 0.5F, 0.5F, 0.5F, 0.6F, 0.7F, 0, 0, 0};
  image.rgb[11] = std::numeric_limits<float>::quiet_NaN();
  image.bands = {1, 2, 3, 4};
  image.band_centres_nm = {550};
  ToneReport report;
  Image const shown = tone_map(image, {.exposure_ev = 1}, &report);
  EXPECT_EQ(shown.rgb[0], 0.5F);
  EXPECT_EQ(report.exposure_ev, 1);
  EXPECT_EQ(report.negative, 1U);
  EXPECT_EQ(report.over_range, 1U);
  EXPECT_EQ(report.not_a_number, 1U);
  EXPECT_TRUE(shown.bands.empty());
}

TEST(ToneMap, AutomaticExposureBringsTheGeometricMeanToMiddleGrey) {
  Image image = make_image(3, 1);
  image.rgb = {0.5F, 0.5F, 0.5F, 2, 2, 2, 0, 0, 0}; // geometric mean of the lit ones: 1
  EXPECT_NEAR(automatic_exposure_ev(image), std::log2(0.18), 1e-14);
  EXPECT_EQ(automatic_exposure_ev(make_image(2, 2)), 0);
  ToneReport report;
  tone_map(image, {.exposure_ev = 1, .auto_exposure = true}, &report);
  EXPECT_NEAR(report.exposure_ev, 1 + std::log2(0.18), 1e-14);
}

TEST(ToneMap, CodesRoundToNearest) {
  Image image = make_image(2, 1);
  image.rgb = {1,
               static_cast<float>(srgb_decode(100.49 / 255)),
               static_cast<float>(srgb_decode(100.51 / 255)),
               0,
               0,
               0};
  std::vector<std::uint8_t> const expected{255, 100, 101, 0, 0, 0};
  EXPECT_EQ(encode_srgb8(image), expected);
}

} // namespace
} // namespace abbe::image
