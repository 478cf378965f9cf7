// SPDX-License-Identifier: MIT
#include "image/colour.hpp"
#include "image/io.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <png.h>

namespace abbe::image {
namespace {

using ::testing::HasSubstr;

class Png : public ImageFiles {
protected:
  /// Pixels as libpng's own simplified reader gives them.
  std::vector<png_byte> read_independently(std::filesystem::path const& path, png_uint_32 format) {
    png_image picture{};
    picture.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&picture, path.c_str())) << picture.message;
    picture.format = format;
    std::vector<png_byte> bytes(PNG_IMAGE_SIZE(picture));
    EXPECT_TRUE(png_image_finish_read(&picture, nullptr, bytes.data(), 0, nullptr))
        << picture.message;
    return bytes;
  }
};

TEST_F(Png, EightBitsAreTheNearestSrgbCodes) {
  Image const image = gradient(40, 30);
  ASSERT_TRUE(write_png(image, at("a.png")));
  std::vector<png_byte> const codes = read_independently(at("a.png"), PNG_FORMAT_RGB);
  for (std::size_t i = 0; i < codes.size(); ++i)
    EXPECT_NEAR(codes[i], 255 * srgb_encode(image.rgb[i]), 0.5 + 1e-12);
}

TEST_F(Png, OurReaderGivesWhatWasWrittenWithinHalfACode) {
  Image image = gradient(40, 30);
  image.metadata = {{"Software", "abbe"}, {"Scene", "gr\xc3\xbcn"}};
  for (int const bits : {8, 16}) {
    ASSERT_TRUE(write_png(image, at("a.png"), {.bits = bits}));
    Result<Image> const back = read(at("a.png"));
    ASSERT_TRUE(back.ok()) << back.error().message;
    double const full = (1 << bits) - 1;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) // 0.01: the curve's joint and float rounding
      EXPECT_NEAR(full * srgb_encode(back->rgb[i]), full * srgb_encode(image.rgb[i]), 0.5 + 0.01);
    EXPECT_EQ(back->metadata, image.metadata);
    EXPECT_TRUE(back->alpha.empty());
  }
}

TEST_F(Png, AlphaIsWrittenUnmultipliedAndReadMultiplied) {
  Image image = make_image(2, 1);
  image.rgb = {0.25F, 0.1F, 0, 0, 0, 0};
  image.alpha = {0.5F, 0};
  ASSERT_TRUE(write_png(image, at("a.png"), {.bits = 16}));
  std::vector<png_byte> const codes = read_independently(at("a.png"), PNG_FORMAT_RGBA);
  EXPECT_EQ(codes[0], 188); // srgb_encode(0.5) = 0.7354
  EXPECT_EQ(codes[3], 128);
  EXPECT_EQ(codes[7], 0);
  Result<Image> const back = read(at("a.png"));
  ASSERT_TRUE(back.ok());
  EXPECT_NEAR(back->rgb[0], 0.25, 2e-5); // two codes of 16 bits
  EXPECT_NEAR(back->alpha[0], 0.5, 1e-5);
}

TEST_F(Png, PngcheckFindsNothingWrong) {
  if (!installed("pngcheck")) GTEST_SKIP() << "pngcheck is not installed";
  Image image = gradient(17, 9);
  image.metadata = {{"Scene", "a.scn"}};
  ASSERT_TRUE(write_png(image, at("a.png")));
  std::string const text = output_of("pngcheck -v -t " + at("a.png").string());
  EXPECT_THAT(text, HasSubstr("No errors detected"));
  EXPECT_THAT(text, HasSubstr("17 x 9 image, 24-bit RGB, non-interlaced"));
  EXPECT_THAT(text, HasSubstr("chunk sRGB"));
  EXPECT_THAT(text, HasSubstr("chunk gAMA"));
  EXPECT_THAT(text, HasSubstr("a.scn"));
}

TEST_F(Png, BadKeysAndDepthsAreErrors) {
  Image image = gradient(3, 3);
  EXPECT_EQ(write_png(image, at("a.png"), {.bits = 12}).error().code, "E0516");
  for (std::string const& key : {std::string(), std::string(80, 'k'), std::string(" a")}) {
    image.metadata = {{key, "v"}};
    EXPECT_EQ(write_png(image, at("a.png")).error().code, "E0516") << key;
  }
  EXPECT_EQ(files(), 0U);
}

/// Writes a PNG with libpng directly: kinds that our writer does not make.
void write_raw(std::filesystem::path const& path, int type, int bits, double file_gamma,
               std::vector<std::vector<png_byte>> rows, png_uint_32 width,
               bool interlaced = false) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_init_io(png, file);
  png_set_IHDR(png, info, width, static_cast<png_uint_32>(rows.size()), bits, type,
               interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, 0, 0);
  if (file_gamma > 0) png_set_gAMA(png, info, file_gamma);
  png_color const palette[2] = {{255, 0, 0}, {0, 188, 10}};
  png_byte const transparency[2] = {255, 128};
  if (type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette, 2);
    png_set_tRNS(png, info, transparency, 2, nullptr);
  }
  std::vector<png_bytep> pointers;
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_info(png, info);
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST_F(Png, ReadsPaletteWithTransparency) {
  write_raw(at("p.png"), PNG_COLOR_TYPE_PALETTE, 1, 0, {{0x40}}, 2); // pixels 0, 1
  Result<Image> const image = read(at("p.png"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  ASSERT_EQ(image->alpha.size(), 2U);
  EXPECT_FLOAT_EQ(image->rgb[0], 1);
  EXPECT_FLOAT_EQ(image->alpha[1], 128.0F / 255);
  EXPECT_NEAR(image->rgb[4], 0.502886 * 128 / 255, 1e-6);
}

TEST_F(Png, ReadsGreyOfFewBitsInterlaced) {
  write_raw(at("g.png"), PNG_COLOR_TYPE_GRAY, 2, 0, {{0x1b}, {0xe4}}, 4, true); // 0 1 2 3 / 3 2 1 0
  Result<Image> const image = read(at("g.png"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  for (int v = 0; v < 4; ++v) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(image->rgb[3 * v + c], static_cast<float>(srgb_decode(v / 3.0)));
      EXPECT_FLOAT_EQ(image->rgb[12 + 3 * v + c], static_cast<float>(srgb_decode((3 - v) / 3.0)));
    }
  }
}

TEST_F(Png, GammaChunkAloneIsAPowerLaw) {
  write_raw(at("g.png"), PNG_COLOR_TYPE_GRAY, 8, 1.0, {{51}}, 1);
  EXPECT_FLOAT_EQ(read(at("g.png"))->rgb[0], 0.2F);
  write_raw(at("h.png"), PNG_COLOR_TYPE_GRAY, 8, 0.5, {{51}}, 1);
  EXPECT_FLOAT_EQ(read(at("h.png"))->rgb[0], 0.04F);
}

TEST_F(Png, ReadsWhatPovRayWrites) {
  if (!installed("povray")) GTEST_SKIP() << "povray is not installed";
  put_bytes(at("p.pov"),
            "#version 3.7; global_settings { assumed_gamma 1 } background { rgb <0.5, 0.18, 1> } "
            "camera { orthographic }");
  output_of("cd " + folder_.string() + " && povray +Ip.pov +Op.png +W8 +H4 -D -GA");
  Result<Image> const image = read(at("p.png"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(encode_srgb8(*image)[0], 188);
  EXPECT_NEAR(image->rgb[0], 0.5, 0.005); // half a code at 188 is 0.003
  EXPECT_NEAR(image->rgb[1], 0.18, 0.002);
  EXPECT_FLOAT_EQ(image->rgb[2], 1);
}

TEST_F(Png, TruncatedAndFlippedFilesGiveErrorsNotCrashes) {
  ASSERT_TRUE(write_png(gradient(30, 20), at("a.png")));
  std::string const good = bytes_of(at("a.png"));
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 50) {
    put_bytes(at("t.png"), good.substr(0, length));
    EXPECT_FALSE(read(at("t.png")).ok()) << length;
  }
  for (std::size_t place = 0; place < good.size(); ++place) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 0x21);
    put_bytes(at("t.png"), bad);
    Result<Image> const result = read(at("t.png"));
    if (!result) {
      EXPECT_EQ(result.error().code.substr(0, 3), "E05");
    }
  }
}

TEST_F(Png, HugeClaimsAreRefusedBeforeAllocation) {
  // 60000 x 60000 in a file of 58 bytes: IHDR with a correct checksum, then an empty IDAT.
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x08\x02\0\0\0", 29);
  auto const crc = [](std::string const& data) {
    std::uint32_t sum = 0xffffffff;
    for (unsigned char const byte : data) {
      sum ^= byte;
      for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320U : 0U);
    }
    sum = ~sum;
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>((sum >> shift) & 0xff);
    return text;
  };
  bytes += crc(bytes.substr(12));
  bytes += std::string(4, '\0') + "IDAT" + crc("IDAT");
  put_bytes(at("b.png"), bytes);
  Result<Image> const result = read(at("b.png"));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, "E0514") << result.error().message; // 3.6e9 pixels
}

} // namespace
} // namespace abbe::image
