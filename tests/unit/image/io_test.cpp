// SPDX-License-Identifier: MIT
#include "image/io.hpp"

#include "image/colour.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <csignal>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace abbe::image {
namespace {

using ::testing::HasSubstr;

class Io : public ImageFiles {};
class Tiff : public ImageFiles {};

TEST_F(Tiff, LuminanceAndChromaticityWithinTheStepsOfLogLuv) {
  Image image = gradient(50, 40);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] *= i < 3000 ? 1e-3F : 1e4F;
  image.rgb[1] = -0.02F; // outside sRGB, luminance still positive with the next
  image.rgb[0] = 1;
  image.metadata = {{"scene", "a.scn"}, {"bands", "450"}};
  ASSERT_TRUE(write_tiff_logluv(image, at("a.tif")));
  Result<Image> const back = read(at("a.tif"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->metadata, image.metadata);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    Vec3 const before = linear_srgb_to_xyz(pixel(image, i));
    Vec3 const after = linear_srgb_to_xyz(pixel(*back, i));
    EXPECT_NEAR(after.y, before.y, before.y * 0.0027) << i; // 2^(1/256) = 1.0027
    Vec2 const uv_before = xyz_to_uv(before);
    Vec2 const uv_after = xyz_to_uv(after);
    EXPECT_NEAR(uv_after.x, uv_before.x, 1.0 / 410) << i;
    EXPECT_NEAR(uv_after.y, uv_before.y, 1.0 / 410) << i;
  }
}

TEST_F(Tiff, BlackStaysBlackAndAlphaIsAnError) {
  Image image = make_image(3, 2);
  ASSERT_TRUE(write_tiff_logluv(image, at("a.tif")));
  Result<Image> const back = read(at("a.tif"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  for (float const value : back->rgb) EXPECT_EQ(value, 0);
  image.alpha.assign(6, 1);
  EXPECT_EQ(write_tiff_logluv(image, at("b.tif")).error().code, "E0516");
  EXPECT_EQ(files(), 1U);
}

TEST_F(Tiff, TiffinfoSeesLogLuv) {
  if (!installed("tiffinfo")) GTEST_SKIP() << "tiffinfo is not installed (package libtiff-tools)";
  ASSERT_TRUE(write_tiff_logluv(gradient(11, 5), at("a.tif")));
  std::string const text = output_of("tiffinfo -d " + at("a.tif").string());
  EXPECT_THAT(text, HasSubstr("Image Width: 11 Image Length: 5"));
  EXPECT_THAT(text, HasSubstr("Compression Scheme: SGILog"));
  EXPECT_THAT(text, HasSubstr("Photometric Interpretation: CIE Log2(L) (u',v')"));
}

TEST_F(Tiff, TruncatedAndFlippedFilesGiveErrorsNotCrashes) {
  ASSERT_TRUE(write_tiff_logluv(gradient(30, 20), at("a.tif")));
  std::string const good = bytes_of(at("a.tif"));
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 50) {
    put_bytes(at("t.tif"), good.substr(0, length));
    EXPECT_FALSE(read(at("t.tif")).ok()) << length;
  }
  for (std::size_t place = 0; place < good.size(); ++place) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ 0x81);
    put_bytes(at("t.tif"), bad);
    Result<Image> const result = read(at("t.tif"));
    if (!result) {
      EXPECT_EQ(result.error().code.substr(0, 3), "E05");
    }
  }
}

TEST_F(Io, ExtensionDecides) {
  Image const image = gradient(4, 4);
  ASSERT_TRUE(write(image, at("a.EXR")));
  ASSERT_TRUE(write(image, at("a.Png")));
  ASSERT_TRUE(write(image, at("a.tif")));
  ASSERT_TRUE(write(image, at("a.tiff")));
  EXPECT_EQ(bytes_of(at("a.EXR")).substr(0, 3), "\x76\x2f\x31");
  EXPECT_EQ(bytes_of(at("a.Png")).substr(1, 3), "PNG");
  EXPECT_EQ(bytes_of(at("a.tif")).substr(0, 2), "II");
  for (char const* name : {"a.webp", "a", "exr", "a.exr.bak"}) {
    Status const status = write(image, at(name));
    ASSERT_FALSE(status.ok()) << name;
    EXPECT_EQ(status.error().code, "E0512");
    for (char const* known : {".exr", ".png", ".tif"})
      EXPECT_THAT(status.error().message, HasSubstr(known));
    EXPECT_EQ(check_destination(at(name)).error().code, "E0512");
  }
}

TEST_F(Io, ContentDecidesWhenReading) {
  ASSERT_TRUE(write(gradient(4, 4), at("a.exr")));
  std::filesystem::rename(at("a.exr"), at("a.png"));
  EXPECT_TRUE(read(at("a.png")).ok());
  put_bytes(at("b.png"), "hello world");
  EXPECT_EQ(read(at("b.png")).error().code, "E0512");
  put_bytes(at("c.png"), "");
  EXPECT_EQ(read(at("c.png")).error().code, "E0513");
}

TEST_F(Io, UnreadableFilesGiveTheReasonOfTheSystem) {
  EXPECT_THAT(read(at("none.exr")).error().message, HasSubstr("No such file or directory"));
  EXPECT_THAT(read(folder_).error().message, HasSubstr("is a directory"));
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_EQ(read(at("pipe")).error().code, "E0511"); // and does not wait for a writer
}

TEST_F(Io, UnwritablePlacesGiveTheReasonOfTheSystem) {
  Image const image = gradient(4, 4);
  std::filesystem::create_directory(at("dir.png"));
  for (auto const& path : {at("none") / "a.exr", at("none") / "a.png", at("none") / "a.tif"}) {
    Status const status = write(image, path);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, "E0510");
    EXPECT_THAT(status.error().message, HasSubstr("No such file or directory"));
    EXPECT_EQ(check_destination(path).error().code, "E0510");
  }
  EXPECT_THAT(write(image, at("dir.png")).error().message, HasSubstr("directory"));
  EXPECT_EQ(write_png(image, "/dev/null").error().code, "E0510"); // never replaced by a file
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_TRUE(check_destination(at("new.png")).ok());
}

TEST_F(Io, AFullDiskLeavesTheOldFileAndNoOther) {
  Image image = make_image(300, 300);
  std::uint64_t bits = 1; // noise, so that no format compresses it below the limit
  for (float& value : image.rgb) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;
    value = static_cast<float>(bits >> 40) * 0x1p-24F;
  }
  for (char const* name : {"a.exr", "a.png", "a.tif"}) put_bytes(at(name), "old");
  std::vector<Status> results;
  // A limit on file sizes fails the way a full disk does. SIGXFSZ would kill.
  auto const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  ::getrlimit(RLIMIT_FSIZE, &old_limit);
  rlimit limit = old_limit;
  limit.rlim_cur = 20000;
  ::setrlimit(RLIMIT_FSIZE, &limit);
  for (char const* name : {"a.exr", "a.png", "a.tif"}) results.push_back(write(image, at(name)));
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, handler);
  for (Status const& status : results) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, "E0510");
    EXPECT_THAT(status.error().message, HasSubstr("File too large"));
  }
  for (char const* name : {"a.exr", "a.png", "a.tif"}) EXPECT_EQ(bytes_of(at(name)), "old");
  EXPECT_EQ(files(), 3U);
}

TEST_F(Io, LinksAreFollowed) {
  std::filesystem::create_directory(at("real"));
  put_bytes(at("real") / "a.png", "old");
  std::filesystem::create_symlink(at("real") / "a.png", at("link.png"));
  ASSERT_TRUE(write(gradient(4, 4), at("link.png")));
  EXPECT_TRUE(std::filesystem::is_symlink(at("link.png")));
  EXPECT_TRUE(read(at("real") / "a.png").ok());
}

TEST_F(Io, ImagesThatDoNotFitTogetherAreErrors) {
  Image image = gradient(4, 4);
  image.rgb.pop_back();
  for (char const* name : {"a.exr", "a.png", "a.tif"})
    EXPECT_EQ(write(image, at(name)).error().code, "E0515");
  Image empty;
  EXPECT_EQ(validate(empty).error().code, "E0515");
  Image bands = gradient(2, 2);
  bands.band_centres_nm = {500, 400};
  EXPECT_EQ(validate(bands).error().code, "E0515");
}

} // namespace
} // namespace abbe::image
