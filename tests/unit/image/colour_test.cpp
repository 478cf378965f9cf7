// SPDX-License-Identifier: MIT
#include "image/colour.hpp"

#include <array>
#include <gtest/gtest.h>

namespace abbe::image {
namespace {

TEST(Colour, SrgbMatrixMatchesTheStandard) {
  // IEC 61966-2-1 prints four digits.
  Vec3 const red = linear_srgb_to_xyz({1, 0, 0});
  Vec3 const green = linear_srgb_to_xyz({0, 1, 0});
  Vec3 const blue = linear_srgb_to_xyz({0, 0, 1});
  double const expected[9] = {0.4124, 0.2126, 0.0193, 0.3576, 0.7152,
                              0.1192, 0.1805, 0.0722, 0.9505};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(red[c], expected[c], 5.1e-5);
    EXPECT_NEAR(green[c], expected[3 + c], 5.1e-5);
    EXPECT_NEAR(blue[c], expected[6 + c], 1.1e-4); // the standard's last digit of blue Z is 0.9505
  }
}

TEST(Colour, WhiteHasTheChromaticityOfD65AndLuminanceOne) {
  Vec3 const white = linear_srgb_to_xyz(Vec3(1));
  double const sum = white.x + white.y + white.z;
  EXPECT_NEAR(white.x / sum, 0.3127, 1e-15);
  EXPECT_NEAR(white.y / sum, 0.3290, 1e-15);
  EXPECT_NEAR(white.y, 1, 4e-16);
  EXPECT_NEAR(luminance(Vec3(1)), 1, 4e-16);
}

TEST(Colour, XyzRoundTrip) {
  Vec3 const rgb{-0.25, 3.5, 0.125};
  Vec3 const back = xyz_to_linear_srgb(linear_srgb_to_xyz(rgb));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(back[c], rgb[c], 1e-14); // some 20 roundings of values near 4
}

TEST(Colour, SrgbCurveMatchesKnownCodes) {
  // 50 % grey code 188 is 0.5029 linear; code 10/255 lies on the straight part (0.003035).
  EXPECT_NEAR(srgb_decode(188.0 / 255), 0.502886, 5e-7);
  EXPECT_NEAR(srgb_decode(10.0 / 255), 10.0 / 255 / 12.92, 1e-17);
  EXPECT_NEAR(srgb_encode(0.18), 0.461356, 5e-7);
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 2e-16);
  EXPECT_EQ(srgb_encode(-0.5), -srgb_encode(0.5));
}

TEST(Colour, SrgbCurveRoundTripsEveryCode) {
  for (int code = 0; code < 65536; ++code)
    EXPECT_NEAR(srgb_encode(srgb_decode(code / 65535.0)) * 65535, code, 5e-3) << code;
  // 5e-3 of a 16-bit code: the standard's two branches miss each other by 3e-8 at the joint.
}

TEST(Colour, LabOfPrimaries) {
  // Lindbloom's calculator, sRGB D65: red 53.24, 80.09, 67.20; green 87.73, -86.18, 83.18;
  // blue 32.30, 79.19, -107.86; his white is 0.95047, 1, 1.08883, ours 0.950456, 1, 1.089058.
  Vec3 const red = xyz_to_lab(linear_srgb_to_xyz({1, 0, 0}));
  Vec3 const green = xyz_to_lab(linear_srgb_to_xyz({0, 1, 0}));
  Vec3 const blue = xyz_to_lab(linear_srgb_to_xyz({0, 0, 1}));
  double const expected[9] = {53.2408, 80.0925, 67.2032, 87.7347,  -86.1827,
                              83.1793, 32.2970, 79.1875, -107.8602};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(red[c], expected[c], 0.02);
    EXPECT_NEAR(green[c], expected[3 + c], 0.02);
    EXPECT_NEAR(blue[c], expected[6 + c], 0.02);
  }
}

TEST(Colour, GreyHasNoChromaInLabAndLabRoundTrips) {
  for (double const v : {0.0, 1e-4, 0.01, 0.18, 1.0, 4.0}) {
    Vec3 const xyz = linear_srgb_to_xyz(Vec3(v));
    Vec3 const lab = xyz_to_lab(xyz);
    EXPECT_NEAR(lab.y, 0, 1e-12);
    EXPECT_NEAR(lab.z, 0, 1e-12);
    Vec3 const back = lab_to_xyz(lab);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], xyz[c], 1e-14 * (1 + v));
  }
  EXPECT_NEAR(xyz_to_lab(linear_srgb_to_xyz(Vec3(1))).x, 100, 1e-13);
}

TEST(Colour, UvOfD65) {
  Vec2 const uv = xyz_to_uv(linear_srgb_to_xyz(Vec3(1)));
  EXPECT_NEAR(uv.x, 0.1978, 5e-5); // CIE 15: u', v' of D65 = 0.1978, 0.4683
  EXPECT_NEAR(uv.y, 0.4683, 5e-5);
}

/// Table 1 of Sharma, Wu, Dalal (2005); four digits are printed.
constexpr std::array<std::array<double, 7>, 34> sharma_pairs{{
    {50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425},
    {50, 3.1571, -77.2803, 50, 0, -82.7485, 2.8615},
    {50, 2.8361, -74.0200, 50, 0, -82.7485, 3.4412},
    {50, -1.3802, -84.2814, 50, 0, -82.7485, 1.0000},
    {50, -1.1848, -84.8006, 50, 0, -82.7485, 1.0000},
    {50, -0.9009, -85.5211, 50, 0, -82.7485, 1.0000},
    {50, 0, 0, 50, -1, 2, 2.3669},
    {50, -1, 2, 50, 0, 0, 2.3669},
    {50, 2.49, -0.001, 50, -2.49, 0.0009, 7.1792},
    {50, 2.49, -0.001, 50, -2.49, 0.0010, 7.1792},
    {50, 2.49, -0.001, 50, -2.49, 0.0011, 7.2195},
    {50, 2.49, -0.001, 50, -2.49, 0.0012, 7.2195},
    {50, -0.001, 2.49, 50, 0.0009, -2.49, 4.8045},
    {50, -0.001, 2.49, 50, 0.0010, -2.49, 4.8045},
    {50, -0.001, 2.49, 50, 0.0011, -2.49, 4.7461},
    {50, 2.5, 0, 50, 0, -2.5, 4.3065},
    {50, 2.5, 0, 73, 25, -18, 27.1492},
    {50, 2.5, 0, 61, -5, 29, 22.8977},
    {50, 2.5, 0, 56, -27, -3, 31.9030},
    {50, 2.5, 0, 58, 24, 15, 19.4535},
    {50, 2.5, 0, 50, 3.1736, 0.5854, 1.0000},
    {50, 2.5, 0, 50, 3.2972, 0, 1.0000},
    {50, 2.5, 0, 50, 1.8634, 0.5757, 1.0000},
    {50, 2.5, 0, 50, 3.2592, 0.3350, 1.0000},
    {60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644},
    {63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630},
    {61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731},
    {35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645},
    {22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373},
    {36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146},
    {90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441},
    {90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381},
    {6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377},
    {2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082},
}};

TEST(Ciede2000, MatchesTheThirtyFourPairsOfSharma) {
  for (auto const& p : sharma_pairs) {
    Vec3 const one{p[0], p[1], p[2]};
    Vec3 const two{p[3], p[4], p[5]};
    EXPECT_NEAR(ciede2000(one, two), p[6], 5e-5) << one.x << ' ' << one.y << ' ' << one.z;
    EXPECT_NEAR(ciede2000(two, one), p[6], 5e-5);
    EXPECT_EQ(ciede2000(one, one), 0);
  }
}

} // namespace
} // namespace abbe::image
