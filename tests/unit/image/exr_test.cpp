// SPDX-License-Identifier: MIT
#include "image/io.hpp"
#include "image/spectral_layout.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>

namespace abbe::image {
namespace {

using ::testing::HasSubstr;

class Exr : public ImageFiles {};

Image spectral_image() {
  Image image = gradient(19, 7);
  image.band_centres_nm = {380.5, 450, 589.2938, 700.0 + 1.0 / 3, 1000};
  image.band_edges_nm = {360, 401, 500, 650, 800, 1200.25};
  for (std::size_t i = 0; i < image.pixels() * 5; ++i)
    image.bands.push_back(1e-3F * static_cast<float>(i) - 0.1F);
  image.metadata = {{"scene", "a.scn"}, {"zeit", "Gr\xc3\xbc\xc3\x9f"}};
  return image;
}

TEST_F(Exr, FloatsComeBackBitForBit) {
  Image image = gradient(33, 21);
  float const special[] = {-0.5F,
                           65505.0F,
                           1e-42F,
                           -0.0F,
                           std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::max()};
  std::memcpy(image.rgb.data(), special, sizeof special);
  image.alpha.assign(image.pixels(), 0.25F);
  ASSERT_TRUE(write_exr(image, at("a.exr")));
  Result<Image> back = read(at("a.exr"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back->rgb.size(), image.rgb.size());
  EXPECT_EQ(std::memcmp(back->rgb.data(), image.rgb.data(), image.rgb.size() * sizeof(float)), 0);
  EXPECT_EQ(back->alpha, image.alpha);
  EXPECT_TRUE(back->bands.empty());
  EXPECT_EQ(files(), 1U);
}

TEST_F(Exr, SpectralImageComesBackWhole) {
  Image const image = spectral_image();
  ASSERT_TRUE(write_exr(image, at("s.exr"), {.spectral = true}));
  Result<Image> back = read(at("s.exr"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->rgb, image.rgb);
  EXPECT_EQ(back->bands, image.bands);
  EXPECT_EQ(back->band_centres_nm, image.band_centres_nm);
  EXPECT_EQ(back->band_edges_nm, image.band_edges_nm);
  EXPECT_EQ(back->metadata, image.metadata);
}

TEST_F(Exr, BandsStayOutUnlessAskedFor) {
  ASSERT_TRUE(write_exr(spectral_image(), at("s.exr")));
  EXPECT_TRUE(read(at("s.exr"))->bands.empty());
}

TEST_F(Exr, HalfRoundsToElevenBits) {
  Image const image = gradient(16, 16);
  ASSERT_TRUE(write_exr(image, at("h.exr"), {.depth = ExrOptions::Depth::Half}));
  Result<Image> back = read(at("h.exr"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) // half an ulp of 11 bits, or of a subnormal
    EXPECT_NEAR(back->rgb[i], image.rgb[i], std::max(image.rgb[i] * 0x1p-11F, 0x1p-25F));
}

TEST_F(Exr, HalfRefusesValuesBeyondItsRange) {
  Image image = gradient(4, 4);
  image.rgb[7] = 65520; // rounds up to infinity
  Status const status = write_exr(image, at("h.exr"), {.depth = ExrOptions::Depth::Half});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, "E0516");
  EXPECT_THAT(status.error().message, HasSubstr("65520"));
  EXPECT_EQ(files(), 0U);
}

TEST_F(Exr, SpectralWithoutBandsIsAnError) {
  EXPECT_EQ(write_exr(gradient(4, 4), at("s.exr"), {.spectral = true}).error().code, "E0516");
}

TEST_F(Exr, SameImageSameBytes) {
  ASSERT_TRUE(write_exr(spectral_image(), at("a.exr"), {.spectral = true}));
  ASSERT_TRUE(write_exr(spectral_image(), at("b.exr"), {.spectral = true}));
  EXPECT_EQ(bytes_of(at("a.exr")), bytes_of(at("b.exr")));
}

TEST_F(Exr, HeaderReadsAsTheLayoutDemandsInOpenExrsOwnTool) {
  if (!installed("exrheader")) GTEST_SKIP() << "exrheader is not installed (package openexr)";
  ASSERT_TRUE(write_exr(spectral_image(), at("s.exr"), {.spectral = true}));
  std::string const text = output_of("exrheader " + at("s.exr").string());
  EXPECT_THAT(text, HasSubstr("spectralLayoutVersion (type string): \"1.0\""));
  EXPECT_THAT(text, HasSubstr("emissiveUnits (type string): \"W.m^-2.sr^-1\""));
  EXPECT_THAT(text, HasSubstr("S0.380,5nm, 32-bit floating-point, sampling 1 1"));
  EXPECT_THAT(text, HasSubstr("S0.450nm, 32-bit floating-point"));
  EXPECT_THAT(text, HasSubstr("    R, 32-bit floating-point"));
  EXPECT_THAT(text, HasSubstr("dataWindow (type box2i): (0 0) - (18 6)"));
  EXPECT_THAT(text, HasSubstr("scene (type string): \"a.scn\""));
}

TEST_F(Exr, EveryTruncationAndManyFlippedBytesGiveAnErrorOrAnImage) {
  Image const image = spectral_image();
  ASSERT_TRUE(write_exr(image, at("s.exr"), {.spectral = true}));
  std::string const good = bytes_of(at("s.exr"));
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 64) {
    put_bytes(at("t.exr"), good.substr(0, length));
    EXPECT_FALSE(read(at("t.exr")).ok()) << length;
  }
  for (std::size_t place = 0; place < std::min<std::size_t>(good.size(), 2500); ++place) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (place % 2 ? 0xff : 0x10));
    put_bytes(at("t.exr"), bad);
    Result<Image> const result = read(at("t.exr"));
    if (!result) {
      EXPECT_EQ(result.error().code.substr(0, 3), "E05");
    }
  }
}

TEST_F(Exr, HugeClaimsAreRefusedBeforeAllocation) {
  ASSERT_TRUE(write_exr(gradient(8, 8), at("a.exr")));
  std::string bytes = bytes_of(at("a.exr"));
  std::size_t const window = bytes.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
  for (std::int32_t const last : {39999, 0x7ffffffe}) {
    std::memcpy(&bytes[window + 8], &last, 4);
    std::memcpy(&bytes[window + 12], &last, 4);
    put_bytes(at("b.exr"), bytes);
    Result<Image> const result = read(at("b.exr"));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, last == 39999 ? "E0513" : "E0514") << result.error().message;
  }
}

TEST(SpectralLayout, NamesOfChannelsRoundTrip) {
  EXPECT_EQ(spectral_channel_name(550.5), "S0.550,5nm");
  EXPECT_EQ(spectral_channel_name(380), "S0.380nm");
  for (double const nm : {360.0, 589.2938, 1000.0 / 3, 0.1, 123456.789})
    EXPECT_EQ(parse_spectral_channel(spectral_channel_name(nm)), nm);
}

TEST(SpectralLayout, ReadsWhatThePaperAllows) {
  EXPECT_EQ(parse_spectral_channel("S0.550,000000nm"), 550);
  EXPECT_DOUBLE_EQ(*parse_spectral_channel("S0.5,5e+2nm"), 550);
  EXPECT_DOUBLE_EQ(*parse_spectral_channel("S0.0,55um"), 550);
  EXPECT_DOUBLE_EQ(*parse_spectral_channel("S0.500THz"), 299792458.0 / 500e12 * 1e9);
  for (char const* name : {"R", "S1.550nm", "S0.nm", "S0.550", "S0.550.5nm", "S0.-3nm", "S0.0nm",
                           "S0.5xm", "T.550nm", "S0.infnm", "S0.nannm"})
    EXPECT_EQ(parse_spectral_channel(name), std::nullopt) << name;
}

} // namespace
} // namespace abbe::image
