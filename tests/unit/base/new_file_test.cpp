// SPDX-License-Identifier: MIT
#include "base/new_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace abbe {
namespace {

namespace fs = std::filesystem;

class NewFiles : public ::testing::Test {
protected:
  NewFiles() {
    std::string name = (fs::temp_directory_path() / "abbe-new-file-XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~NewFiles() override { fs::remove_all(folder); }
  static unsigned mode(fs::path const& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? status.st_mode & 0777u : 0;
  }
  fs::path folder;
};

TEST_F(NewFiles, LieBesideTheirTargetUnderNamesOfTheirOwn) {
  auto const one = make_file_beside(folder / "a.png"), two = make_file_beside(folder / "a.png");
  ASSERT_GE(one.descriptor, 0);
  ASSERT_GE(two.descriptor, 0);
  EXPECT_NE(one.path, two.path);
  EXPECT_EQ(one.path.parent_path(), folder);
  EXPECT_TRUE(fs::is_empty(one.path));
  close(one.descriptor);
  close(two.descriptor);
}

TEST_F(NewFiles, HaveTheModeOfWhatTheyReplace) {
  std::ofstream(folder / "old") << "x";
  fs::permissions(folder / "old", fs::perms(0640));
  auto const file = make_file_beside(folder / "old");
  take_over_rights(file.descriptor, folder / "old");
  EXPECT_EQ(mode(file.path), 0640u);
  auto const other = make_file_beside(folder / "nothing there");
  unsigned const before = mode(other.path);
  take_over_rights(other.descriptor, folder / "nothing there");
  EXPECT_EQ(mode(other.path), before);
  close(file.descriptor);
  close(other.descriptor);
}

/// A killed process leaves its file without its lock.
TEST_F(NewFiles, TakeAwayWhatKilledOnesOfTheSameTargetLeft) {
  auto const killed = make_file_beside(folder / "a.png"),
             other = make_file_beside(folder / "b.png"),
             working = make_file_beside(folder / "a.png");
  close(killed.descriptor);
  close(other.descriptor);
  fs::path const foreign = folder / ".a.png.backup.tmp",
                 longer = folder / ".a.png.0123456789abcdefg.tmp";
  std::ofstream(foreign) << "x";
  std::ofstream(longer) << "x";
  auto const next = make_file_beside(folder / "a.png");
  EXPECT_FALSE(fs::exists(killed.path));
  for (fs::path const& kept : {other.path, working.path, foreign, longer, next.path})
    EXPECT_TRUE(fs::exists(kept)) << kept;
  close(working.descriptor);
  close(next.descriptor);
}

TEST_F(NewFiles, CannotBeWhereThereIsNoFolder) {
  EXPECT_LT(make_file_beside(folder / "no" / "file").descriptor, 0);
}

} // namespace
} // namespace abbe
