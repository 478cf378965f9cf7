// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace abbe {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own.
class ReadFiles : public testing::Test {
protected:
  void SetUp() override {
    folder_ =
        fs::canonical(fs::temp_directory_path()) / ("abbe-read-file-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "inner");
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(std::string const& name) const { return (folder_ / name).string(); }
  void write(std::string const& name, std::string const& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::string reason(std::string const& name) const {
    auto const file = read_file(path(name));
    return file ? "none" : file.error().message;
  }

private:
  fs::path folder_;
};

TEST_F(ReadFiles, AreTheBytesOfTheFile) {
  for (std::size_t const size : {std::size_t{0}, std::size_t{3}, std::size_t{3} << 20}) {
    std::string const text(size, 'x');
    write("t", text);
    auto const file = read_file(path("t"));
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->text.view() == text);
    EXPECT_EQ(file->place, path("t"));
  }
}

TEST_F(ReadFiles, TellWhereTheyLie) {
  write("t", "text");
  fs::create_symlink("../t", path("inner/link"));
  EXPECT_EQ(read_file(path("inner/link"))->place, path("t"));
  EXPECT_EQ(read_file(path("inner/../t"))->place, path("t"));
}

TEST_F(ReadFiles, GiveTheSystemsReason) {
  EXPECT_EQ(reason("none"), "No such file or directory");
  EXPECT_EQ(reason("inner"), "Is a directory");
  EXPECT_EQ(read_file("").error().message, "No such file or directory");
  EXPECT_EQ(read_file("/dev/zero").error().message, "Not a regular file");
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(reason("pipe"), "Not a regular file");
  write("closed", "text");
  fs::permissions(path("closed"), fs::perms::none);
  if (geteuid() == 0) return; // root reads everything
  EXPECT_EQ(reason("closed"), "Permission denied");
}

} // namespace
} // namespace abbe
