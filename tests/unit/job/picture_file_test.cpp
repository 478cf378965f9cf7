// SPDX-License-Identifier: MIT
#include "job/picture_file.hpp"

#include "image/io.hpp"
#include "still_life.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace abbe::job::testing {
namespace {

using ::testing::Contains;
using ::testing::Key;
using ::testing::Pair;

class PictureFiles : public Jobs {
protected:
  PictureFile file(image::WriteOptions const& write = {}) const {
    return {path, write, head_of(options.render, *plan, "table.scn")};
  }
  std::string bytes() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path path = folder / "picture.exr";
};

TEST_F(PictureFiles, HoldThePicture) {
  image::WriteOptions write;
  write.exr.spectral = true;
  options.render.spectral_output = true;
  auto sink = file(write);
  auto const outcome = make(sink);
  ASSERT_EQ(outcome.end, Outcome::End::Done);
  auto const read = image::read_exr(path);
  ASSERT_TRUE(read);
  auto const wanted = directly().image;
  EXPECT_EQ(read->width, 37);
  EXPECT_EQ(read->rgb, wanted.rgb);
  EXPECT_EQ(read->bands, wanted.bands);
  EXPECT_THAT(read->metadata, Contains(Pair("Scene", "table.scn")));
  EXPECT_THAT(read->metadata, Contains(Pair("Seed", "0")));
  EXPECT_THAT(read->metadata, Contains(Pair("AntiAliasing", "off")));
  EXPECT_THAT(read->metadata, Contains(Pair("Plan", plan::describe(*plan))));
  EXPECT_THAT(read->metadata, Contains(Key("MissingLight")));
  EXPECT_THAT(read->metadata, ::testing::Not(Contains(Key("Passes"))));
}

TEST_F(PictureFiles, TellPasses) {
  options.render.anti_aliasing = jittered();
  options.render.passes = 3;
  options.render.seed = 9;
  auto sink = file();
  ASSERT_EQ(make(sink).end, Outcome::End::Done);
  auto const read = image::read_exr(path);
  ASSERT_TRUE(read);
  EXPECT_THAT(read->metadata, Contains(Pair("Passes", "3")));
  EXPECT_THAT(read->metadata, Contains(Pair("Seed", "9")));
  EXPECT_THAT(read->metadata, Contains(Pair("AntiAliasing", "2")));
}

TEST_F(PictureFiles, OfRegionsHaveTheirSize) {
  options.render.region = render::Region{3, 2, 20, 11};
  auto sink = file();
  ASSERT_EQ(make(sink).end, Outcome::End::Done);
  auto const read = image::read_exr(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->width, 17);
  EXPECT_EQ(read->height, 9);
}

TEST_F(PictureFiles, AreTheSameBytesWhenResumed) {
  {
    auto sink = file();
    ASSERT_EQ(make(sink).end, Outcome::End::Done);
  }
  auto const whole = bytes();
  fs::remove(path);
  keep();
  {
    stop_after(50);
    auto sink = file();
    ASSERT_EQ(make(sink).end, Outcome::End::Interrupted);
  }
  EXPECT_FALSE(fs::exists(path)) << "it appears when it is complete";
  options.render.stop = nullptr;
  options.keeping.resume = true;
  {
    auto sink = file();
    ASSERT_EQ(make(sink).end, Outcome::End::Done);
  }
  EXPECT_EQ(bytes(), whole);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(PictureFiles, LeaveAnOlderFileUntilTheyAreComplete) {
  std::ofstream(path) << "older";
  stop_after(50);
  {
    auto sink = file();
    ASSERT_EQ(make(sink).end, Outcome::End::Interrupted);
  }
  EXPECT_EQ(bytes(), "older");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(PictureFiles, ThatCannotBeWrittenEndTheJob) {
  path = folder / "not there" / "picture.exr";
  auto sink = file();
  auto const outcome = make(sink);
  EXPECT_EQ(outcome.end, Outcome::End::NotTaken);
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->code, "E0510");
}

} // namespace
} // namespace abbe::job::testing
