// SPDX-License-Identifier: MIT
#include "render/checkpoint.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

/// The file of finished tiles by itself: what is read back, and what is not.
namespace abbe::render {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t identity = 0x1234;
constexpr std::uint32_t tiles = 6, passes = 2;

TileResult result_of(std::uint32_t pass, std::uint32_t tile) {
  TileResult out;
  for (std::uint32_t i = 0; i < 5 + tile; ++i)
    out.values.push_back(0.1f * static_cast<float>(i) - static_cast<float>(pass));
  out.counts.camera = 100 + tile;
  out.counts.shadow = pass;
  out.cut.paths = tile;
  out.cut.sum = 7;
  out.cut.worst_sample = 0.25;
  return out;
}

class Checkpoints : public ::testing::Test {
protected:
  Checkpoints() {
    std::string name = (fs::temp_directory_path() / "abbe-XXXXXX").string();
    folder = ::mkdtemp(name.data());
    path = folder / "picture.png.abbe-checkpoint";
  }
  ~Checkpoints() override { fs::remove_all(folder); }

  /// Leaves a file with these tiles, all of pass 0.
  void leave(std::vector<std::uint32_t> const& kept) const {
    Checkpoint checkpoint(path, 0, [] { return identity; });
    checkpoint.begin(tiles, passes);
    for (auto const tile : kept) checkpoint.keep(0, tile, result_of(0, tile));
    EXPECT_EQ(checkpoint.problem(), "");
    EXPECT_TRUE(checkpoint.written());
  }
  std::string bytes() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(std::string const& content) const { std::ofstream(path, std::ios::binary) << content; }
  /// How many tiles a later render finds. @return the code of the error, or the number
  std::string found(std::uint64_t of = identity) const {
    Checkpoint checkpoint(path, 0, [of] { return of; });
    auto const result = checkpoint.resume();
    return result ? std::to_string(*result) : result.error().code;
  }
  static void expect_tile(Checkpoint const& checkpoint, std::uint32_t pass, std::uint32_t tile) {
    auto const got = checkpoint.find(pass, tile);
    ASSERT_TRUE(got) << tile;
    TileResult const wanted = result_of(pass, tile);
    EXPECT_EQ(got->values, wanted.values);
    EXPECT_EQ(got->counts.camera, wanted.counts.camera);
    EXPECT_EQ(got->counts.shadow, wanted.counts.shadow);
    EXPECT_EQ(got->counts.total(), wanted.counts.total());
    EXPECT_EQ(got->cut.paths, wanted.cut.paths);
    EXPECT_EQ(got->cut.sum, wanted.cut.sum);
    EXPECT_EQ(got->cut.worst_sample, wanted.cut.worst_sample);
  }

  fs::path folder, path;
};

TEST_F(Checkpoints, GiveBackWhatTheyWereGiven) {
  {
    Checkpoint checkpoint(path, 0, [] { return identity; });
    checkpoint.begin(tiles, passes);
    EXPECT_FALSE(checkpoint.find(0, 0));
    for (auto const& [pass, tile] : {std::pair(0u, 3u), {1u, 3u}, {1u, 0u}, {0u, 5u}})
      checkpoint.keep(pass, tile, result_of(pass, tile));
  }
  Checkpoint later(path, 0, [] { return identity; });
  auto const count = later.resume();
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 4u);
  later.begin(tiles, passes);
  for (std::uint32_t pass = 0; pass < passes; ++pass)
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
      bool const kept = tile == 3 || (pass == 1 && tile == 0) || (pass == 0 && tile == 5);
      if (kept)
        expect_tile(later, pass, tile);
      else
        EXPECT_FALSE(later.find(pass, tile)) << pass << " " << tile;
    }
}

TEST_F(Checkpoints, GrowOverSeveralRenders) {
  leave({1, 2});
  for (std::uint32_t const tile : {4u, 0u, 5u}) {
    Checkpoint checkpoint(path, 0, [] { return identity; });
    ASSERT_TRUE(checkpoint.resume());
    checkpoint.begin(tiles, passes);
    checkpoint.keep(0, tile, result_of(0, tile));
  }
  Checkpoint checkpoint(path, 0, [] { return identity; });
  EXPECT_EQ(*checkpoint.resume(), 5u);
  for (std::uint32_t const tile : {0u, 1u, 2u, 4u, 5u}) expect_tile(checkpoint, 0, tile);
}

TEST_F(Checkpoints, OfNothingAreEmpty) {
  EXPECT_EQ(found(), "0");
  leave({0});
  Checkpoint checkpoint(path, 0, [] { return identity; });
  ASSERT_TRUE(checkpoint.resume());
  checkpoint.remove();
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(checkpoint.written());
  EXPECT_EQ(found(), "0");
}

TEST_F(Checkpoints, OfAnotherPictureAreRefused) {
  leave({0, 1});
  EXPECT_EQ(found(), "2");
  EXPECT_EQ(found(identity + 1), "E0520");
}

TEST_F(Checkpoints, OfOneRenderAreNotTakenByAnother) {
  Checkpoint checkpoint(path, 0, [] { return identity; });
  checkpoint.begin(tiles, passes);
  checkpoint.keep(0, 0, result_of(0, 0));
  EXPECT_EQ(found(), "E0521");
}

TEST_F(Checkpoints, WithoutTheirHeaderAreRefused) {
  leave({0, 1});
  std::string const whole = bytes();
  std::string other = whole;
  other[0] = 'A';
  for (std::string const& content :
       {std::string(), std::string("no checkpoint at all, though long enough for a header"),
        whole.substr(0, 10), whole.substr(0, 31), other}) {
    write(content);
    EXPECT_EQ(found(), "E0521") << content.size();
  }
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_EQ(found(), "E0521");
}

/// No number of the header is believed before its checksum is right.
TEST_F(Checkpoints, WithAChangedHeaderAreRefused) {
  leave({0, 1});
  std::string const whole = bytes();
  for (std::size_t at = 0; at < 40; ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 1);
    write(other);
    EXPECT_EQ(found(), "E0521") << at;
  }
}

/// As only a forged file can be: the header is right, but for another number of tiles.
TEST_F(Checkpoints, OfOtherTilesAreNotTaken) {
  leave({0, 1});
  Checkpoint checkpoint(path, 0, [] { return identity; });
  ASSERT_TRUE(checkpoint.resume());
  checkpoint.begin(tiles + 1, passes);
  EXPECT_FALSE(checkpoint.find(0, 0));
  EXPECT_NE(checkpoint.problem(), "");
}

/// Killed at any moment: whatever of the last tile was written.
TEST_F(Checkpoints, CutShortHaveTheTilesThatAreWhole) {
  leave({3});
  std::size_t const one = bytes().size();
  leave({3, 1});
  std::string const whole = bytes();
  for (std::size_t size = one; size < whole.size(); ++size) {
    write(whole.substr(0, size));
    ASSERT_EQ(found(), "1") << size;
  }
  // What is behind the last whole tile is replaced.
  write(whole.substr(0, whole.size() - 3));
  {
    Checkpoint checkpoint(path, 0, [] { return identity; });
    ASSERT_TRUE(checkpoint.resume());
    checkpoint.begin(tiles, passes);
    EXPECT_FALSE(checkpoint.find(0, 1));
    checkpoint.keep(0, 1, result_of(0, 1));
  }
  EXPECT_EQ(bytes(), whole);
}

TEST_F(Checkpoints, TakeNoTileThatWasChanged) {
  leave({3});
  std::size_t const one = bytes().size();
  leave({3, 1});
  std::string const whole = bytes();
  for (std::size_t at = one; at < whole.size(); ++at) {
    std::string torn = whole;
    torn[at] = static_cast<char>(torn[at] ^ 1);
    write(torn);
    ASSERT_EQ(found(), "1") << at;
  }
}

TEST_F(Checkpoints, AreBegunAfterADelay) {
  bool asked = false;
  Checkpoint checkpoint(path, 1e6, [&] {
    asked = true;
    return identity;
  });
  checkpoint.begin(tiles, passes);
  checkpoint.keep(0, 0, result_of(0, 0));
  EXPECT_FALSE(checkpoint.written());
  EXPECT_FALSE(checkpoint.find(0, 0));
  EXPECT_FALSE(asked) << "the identity takes time";
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Checkpoints, ThatCannotBeWrittenSayWhy) {
  path = folder / "not there" / "picture";
  Checkpoint checkpoint(path, 0, [] { return identity; });
  checkpoint.begin(tiles, passes);
  checkpoint.keep(0, 0, result_of(0, 0));
  EXPECT_FALSE(checkpoint.written());
  EXPECT_EQ(checkpoint.problem(), "No such file or directory");
  checkpoint.keep(0, 1, result_of(0, 1));
  EXPECT_FALSE(checkpoint.find(0, 1));
}

} // namespace
} // namespace abbe::render
