// SPDX-License-Identifier: MIT
#include "image/io.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace abbe::image {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A file's bytes, which is then removed.
class Written {
public:
  Written(Image const& image, std::string const& name, WriteOptions const& options = {}) {
    auto const path = std::filesystem::temp_directory_path()
                      / ("abbe_small_write_" + std::to_string(::getpid()) + name);
    auto const status = write(image, path, options);
    if (status) {
      std::ifstream file(path, std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(file), {});
      std::filesystem::remove(path);
    } else {
      code = status.error().code;
    }
  }
  Bytes bytes;
  std::string code; ///< of the error
};

/// Red, half green, blue; black, white, more than white.
Image six_pixels() {
  Image image = make_image(3, 2);
  image.rgb = {1, 0, 0, 0, 0.5F, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 2, 3, 4};
  return image;
}
// The sRGB code of a half: 255 (1.055 x 0.5^(1/2.4) - 0.055) = 187.5.
constexpr std::uint8_t half = 188;

TEST(SmallWrite, PpmIsAHeadAndTheCodes) {
  Image image = six_pixels();
  image.metadata = {{"Software", "a\nb"}};
  auto const bytes = Written(image, ".ppm").bytes;
  std::string const head = "P6\n# Software: a b\n3 2\n255\n";
  ASSERT_EQ(bytes.size(), head.size() + 18);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + static_cast<int>(head.size())), head);
  EXPECT_EQ(Bytes(bytes.end() - 18, bytes.end()),
            (Bytes{255, 0, 0, 0, half, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255, 255}));
}

TEST(SmallWrite, PpmOfSixteenBitsHasTheHighByteFirst) {
  WriteOptions options;
  options.display.bits = 16;
  auto const bytes = Written(six_pixels(), ".ppm", options).bytes;
  auto const code = static_cast<int>(65535 * (1.055 * std::pow(0.5, 1 / 2.4) - 0.055) + 0.5);
  Bytes const green(bytes.end() - 36 + 8, bytes.end() - 36 + 10);
  EXPECT_EQ(green,
            (Bytes{static_cast<std::uint8_t>(code >> 8), static_cast<std::uint8_t>(code & 255)}));
}

TEST(SmallWrite, CodesOfAGammaArePowers) {
  WriteOptions options;
  options.display.gamma = 2;
  auto const bytes = Written(six_pixels(), ".ppm", options).bytes;
  EXPECT_EQ(bytes[bytes.size() - 14], 180); // 255 sqrt(0.5) = 180.3
}

TEST(SmallWrite, TgaIsFromTheTopAndHasBlueFirst) {
  auto const bytes = Written(six_pixels(), ".tga").bytes;
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 18),
            (Bytes{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 2, 0, 3, 0, 2, 0, 24, 0x20}));
  EXPECT_EQ(Bytes(bytes.begin() + 18, bytes.begin() + 27),
            (Bytes{0, 0, 255, 0, half, 0, 255, 0, 0}));
}

TEST(SmallWrite, TgaWithRunLengthsUnpacksToTheSame) {
  Image image = make_image(300, 1);
  for (int x = 0; x < 300; ++x) // runs, single pixels, a run longer than a packet
    image.rgb[static_cast<std::size_t>(3 * x)] = x < 20    ? float(x) / 20
                                                 : x < 25  ? 0
                                                 : x < 280 ? 1
                                                           : float(x % 3) / 2;
  WriteOptions options;
  options.display.compress = true;
  auto const plain = Written(image, ".tga").bytes, packed = Written(image, ".tga", options).bytes;
  EXPECT_LT(packed.size(), plain.size() / 3);
  EXPECT_EQ(packed[2], 10);
  Bytes out;
  for (std::size_t at = 18; at < packed.size();) {
    std::size_t const count = (packed[at] & 127u) + 1;
    bool const run = packed[at++] & 128;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) out.push_back(packed[at + (run ? c : 3 * i + c)]);
    at += run ? 3 : 3 * count;
  }
  EXPECT_EQ(out, Bytes(plain.begin() + 18, plain.end()));
}

TEST(SmallWrite, AlphaIsKeptWhereTheFormatHasIt) {
  Image image = make_image(1, 1);
  image.rgb = {0.25F, 0, 0};
  image.alpha = {0.5F};
  auto const tga = Written(image, ".tga").bytes;
  EXPECT_EQ(tga[16], 32);
  EXPECT_EQ(Bytes(tga.end() - 4, tga.end()),
            (Bytes{0, 0, half, 128})); // 0.25 / 0.5, not multiplied
  auto const bmp = Written(image, ".bmp").bytes;
  EXPECT_EQ(Bytes(bmp.end() - 4, bmp.end()), (Bytes{0, 0, half, 128}));
  auto const ppm = Written(image, ".ppm").bytes;
  EXPECT_EQ(ppm[ppm.size() - 3], 137); // on black: sRGB of 0.25
}

TEST(SmallWrite, BmpPadsItsRows) {
  auto const bytes = Written(six_pixels(), ".bmp").bytes;
  ASSERT_EQ(bytes.size(), 54u + 2 * 12);
  EXPECT_EQ(bytes[2], bytes.size());
  EXPECT_EQ(Bytes(bytes.begin() + 22, bytes.begin() + 26),
            (Bytes{0xfe, 0xff, 0xff, 0xff})); // from the top
  EXPECT_EQ(Bytes(bytes.begin() + 54, bytes.begin() + 66),
            (Bytes{0, 0, 255, 0, half, 0, 255, 0, 0, 0, 0, 0}));
}

TEST(SmallWrite, HdrSharesAnExponent) {
  Image image = make_image(2, 1);
  image.rgb = {1, 0.5F, 0.25F, 0, 0, 0};
  auto const bytes = Written(image, ".hdr").bytes;
  // 1 = 0.5 x 2^1: mantissas 128, 64, 32 of 256, exponent 129. Too short for packets.
  EXPECT_EQ(Bytes(bytes.end() - 8, bytes.end()), (Bytes{128, 64, 32, 129, 0, 0, 0, 0}));
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 11), "#?RADIANCE\n");
}

TEST(SmallWrite, HdrOfWiderRowsHasEachComponentInPackets) {
  Image image = make_image(130, 1);
  for (float& value : image.rgb) value = 1;
  auto const bytes = Written(image, ".hdr").bytes;
  std::size_t const size = 4 + 4 * (2 + 130);
  Bytes const row(bytes.end() - static_cast<int>(size), bytes.end());
  EXPECT_EQ(Bytes(row.begin(), row.begin() + 5), (Bytes{2, 2, 0, 130, 128}));
  EXPECT_EQ(row[4 + 1 + 128], 2);       // the second packet of red
  EXPECT_EQ(row[4 + 3 * 132 + 1], 129); // the first exponent
}

TEST(SmallWrite, JpegIsOne) {
  auto const bytes = Written(six_pixels(), ".jpg").bytes;
  ASSERT_GT(bytes.size(), 100u);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 3), (Bytes{0xff, 0xd8, 0xff}));
  EXPECT_EQ(Bytes(bytes.end() - 2, bytes.end()), (Bytes{0xff, 0xd9}));
}

TEST(SmallWrite, BitsThatAFormatHasNotAreAnError) {
  WriteOptions options;
  options.display.bits = 16;
  for (auto const* name : {".tga", ".bmp", ".jpg"})
    EXPECT_EQ(Written(six_pixels(), name, options).code, "E0516") << name;
}

} // namespace
} // namespace abbe::image
