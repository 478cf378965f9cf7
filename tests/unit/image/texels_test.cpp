// SPDX-License-Identifier: MIT
#include "image/texels.hpp"

#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <iterator>

namespace abbe::image {
namespace {

using ::testing::HasSubstr;

/// Pictures of 5 x 4 pixels that other programs wrote: Pillow, tiffcp of libtiff.
std::string file(std::string const& name) {
  std::ifstream in(std::string(ABBE_SOURCE_DIR) + "/tests/fuzz/corpus/texels/" + name,
                   std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Texels read(std::string const& name) {
  auto texels = read_texels(file(name), name);
  if (texels) return *texels;
  ADD_FAILURE() << texels.error().message;
  return *make_texels(1, 1, name);
}

using Colour = std::array<double, 4>; ///< codes of 0..255
using Formula = std::function<Colour(int x, int y)>;

Colour rgb(int x, int y) {
  return {16.0 * x + 3, 32.0 * y + 5, 100.0 + 20 * x - 10 * y, 255};
}
Colour rgba(int x, int y) {
  Colour c = rgb(x, y);
  c[3] = 255 - 40.0 * x;
  return c;
}
Colour grey(int x, int y) {
  double const v = 16.0 * x + 3 + 32 * y;
  return {v, v, v, 255};
}
int number(int x, int y) {
  return (x + 2 * y) % 5;
}
Colour palette(int x, int y) {
  constexpr Colour colours[] = {{10, 20, 30, 255},
                                {200, 100, 50, 255},
                                {0, 255, 0, 255},
                                {255, 255, 255, 255},
                                {90, 80, 70, 255}};
  return colours[number(x, y)];
}
/// Entry 3 is transparent.
Colour palette_with_hole(int x, int y) {
  Colour c = palette(x, y);
  if (number(x, y) == 3) c[3] = 0;
  return c;
}
Colour bits(int x, int y) {
  double const v = (x * y + x) % 2 * 255.0;
  return {v, v, v, 255};
}

void expect_pixels(Texels const& texels, Formula const& formula, int width = 5, int height = 4,
                   double tolerance = 1e-5) {
  ASSERT_EQ(texels.width, width);
  ASSERT_EQ(texels.height, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Colour const wanted = formula(x, y);
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_NEAR(255 * texels.rgba[4 * static_cast<std::size_t>(y * width + x) + c], wanted[c],
                    255 * tolerance)
            << "pixel " << x << ", " << y << ", channel " << c;
    }
}

void expect_numbers(Texels const& texels) {
  ASSERT_EQ(texels.index.size(), 20U);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(texels.index[static_cast<std::size_t>(5 * y + x)], number(x, y));
}

TEST(Texels, FilesOfEveryKindHaveTheirPixels) {
  struct Case {
    char const* name;
    Colour (*formula)(int, int);
  };
  constexpr Case cases[] = {
      {"rgb.png", rgb},          {"rgba.png", rgba},        {"grey.png", grey},
      {"rgb.bmp", rgb},          {"bits1.bmp", bits},       {"rgb.tga", rgb},
      {"grey_packed.tga", grey}, {"rgba_packed.tga", rgba}, {"ascii.pgm", grey},
      {"ascii.ppm", rgb},        {"raw.pgm", grey},         {"raw.ppm", rgb},
      {"deep.ppm", rgb},         {"plain.tif", rgb},        {"lzw.tif", rgb},
      {"zip.tif", rgb},          {"packbits.tif", rgb},     {"planes.tif", rgb},
      {"bigtiff.tif", rgb},      {"grey.tif", grey},        {"rgba.tif", rgba},
      {"bits1.tif", bits},       {"fax.tif", bits},
  };
  for (Case const& of : cases) {
    SCOPED_TRACE(of.name);
    expect_pixels(read(of.name), of.formula);
  }
}

TEST(Texels, PalettesKeepTheirNumbers) {
  for (char const* const name : {"palette.bmp", "palette.tga", "palette.tif"}) {
    SCOPED_TRACE(name);
    Texels const texels = read(name);
    // Pillow writes a TIFF's palette as 256 times the code.
    double const tolerance = std::string(name) == "palette.tif" ? 0.004 : 1e-5;
    expect_pixels(texels, palette, 5, 4, tolerance);
    expect_numbers(texels);
  }
  for (char const* const name : {"palette.png", "palette.gif"}) {
    SCOPED_TRACE(name);
    Texels const texels = read(name);
    EXPECT_TRUE(texels.has_alpha);
    expect_pixels(texels, palette_with_hole);
    expect_numbers(texels);
  }
}

TEST(Texels, AnInterlacedGifHasItsRowsInOrder) {
  expect_pixels(
      read("interlaced.gif"), [](int x, int y) { return palette(x / 4, y / 5); }, 20, 20);
}

TEST(Texels, SixteenBitsAreKept) {
  for (char const* const name : {"grey16.tif", "grey16_big.tif"}) {
    SCOPED_TRACE(name);
    expect_pixels(
        read(name),
        [](int x, int y) {
          double const v = (grey(x, y)[0] * 257 + 7) / 257;
          return Colour{v, v, v, 255};
        },
        5, 4, 1e-7);
  }
}

TEST(Texels, RealNumbersAreTakenAsTheyAre) {
  expect_pixels(read("real.tif"), [](int x, int y) {
    double const v = 255 * grey(x, y)[0] / 64;
    return Colour{v, v, v, 255};
  });
}

/// A mantissa m stands for (m + 1/2) / 256, the middle of what was rounded to it.
Colour radiance(int x, int y) {
  Colour c = rgb(x % 5, y);
  for (std::size_t k = 0; k < 3; ++k) c[k] = (c[k] + 0.5) * 255 / 256 * (1 << y);
  return c;
}
TEST(Texels, RadianceFilesAreLight) {
  Texels const flat = read("flat.hdr");
  EXPECT_EQ(flat.gamma, 1);
  expect_pixels(flat, radiance);
  expect_pixels(read("packed.hdr"), radiance, 9, 4);
}

Colour ramp(int x, int y) {
  return {5.0 * x, 6.0 * y, 3.0 * x + 4 * y, 255};
}
TEST(Texels, TilesLieSideBySide) {
  expect_pixels(read("tiled.tif"), ramp, 20, 18);
}

TEST(Texels, JpegComesBackWithinItsLoss) {
  expect_pixels(
      read("flat.jpg"),
      [](int, int) {
        return Colour{120, 130, 140, 255};
      },
      20, 18, 0.004);
  expect_pixels(read("progressive.jpg"), ramp, 20, 18, 0.05);
  expect_pixels(read("jpeg.tif"), ramp, 20, 18, 0.05);
  expect_pixels(
      read("grey.jpg"),
      [](int x, int y) {
        Colour const c = ramp(x, y);
        double const v = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
        return Colour{v, v, v, 255};
      },
      20, 18, 0.03);
}

TEST(Texels, JpegIsSrgbAndTiffIsLight) {
  EXPECT_EQ(read("flat.jpg").default_gamma, -1);
  EXPECT_EQ(read("rgb.png").default_gamma, -1);
  EXPECT_EQ(read("rgb.tga").default_gamma, -1);
  EXPECT_EQ(read("palette.gif").default_gamma, -1);
  EXPECT_EQ(read("plain.tif").default_gamma, 0);
  EXPECT_EQ(read("raw.ppm").default_gamma, 0);
}

TEST(Texels, OpenExrIsLight) {
  Texels const texels = read("half.exr");
  EXPECT_EQ(texels.gamma, 1);
  EXPECT_FALSE(texels.has_alpha);
}

TEST(Texels, InksAreRefused) {
  auto const texels = read_texels(file("inks.jpg"), "inks.jpg");
  ASSERT_FALSE(texels);
  EXPECT_EQ(texels.error().code, "E0516");
  EXPECT_THAT(texels.error().message, HasSubstr("inks"));
}

TEST(Texels, WhatBreaksOffIsDamaged) {
  for (char const* const name :
       {"rgb.png", "rgb.bmp", "rgb.tga", "rgba_packed.tga", "raw.ppm", "ascii.ppm", "palette.gif",
        "flat.hdr", "packed.hdr", "flat.jpg", "progressive.jpg", "plain.tif", "lzw.tif",
        "tiled.tif", "half.exr"}) {
    SCOPED_TRACE(name);
    std::string const whole = file(name);
    auto const texels = read_texels(std::string_view(whole).substr(0, whole.size() * 2 / 3), name);
    ASSERT_FALSE(texels);
    EXPECT_EQ(texels.error().code, "E0513");
    EXPECT_THAT(texels.error().message, HasSubstr(name));
  }
}

TEST(Texels, OtherFilesAreNoPictures) {
  auto const texels = read_texels("sphere { 0, 1 }", "a.pov");
  ASSERT_FALSE(texels);
  EXPECT_EQ(texels.error().code, "E0512");
}

TEST(Texels, ASizeThatTheFileCannotHoldIsRefused) {
  // 65535 x 65535 pixels of a PPM file of a few bytes.
  auto const texels = read_texels("P6 65535 65535 255 abc", "big.ppm");
  ASSERT_FALSE(texels);
  EXPECT_EQ(texels.error().code, "E0513");
}

} // namespace
} // namespace abbe::image
