// SPDX-License-Identifier: MIT
#include "base/file_text.hpp"
#include "base/source.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace abbe {
namespace {

class FileTexts : public ::testing::Test {
protected:
  std::string path(std::string const& name) const { return (folder_ / name).string(); }
  std::string write(std::string const& name, std::string const& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path()
              / ("abbe_file_text_"
                 + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

private:
  std::filesystem::path folder_;
};

/// Lines of ten bytes with their numbers, in more than a megabyte.
std::string many_lines(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i) {
    std::string const number = std::to_string(i);
    text += std::string(9 - number.size(), ' ') + number + '\n';
  }
  return text;
}

TEST_F(FileTexts, AreTheBytesOfTheFile) {
  for (std::string const& text : {std::string(), std::string("a\0b\r\n", 5), many_lines(200000)}) {
    auto const read = FileText::read(write("t", text));
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->view() == text);
    EXPECT_EQ(read->size(), text.size());
    EXPECT_FALSE(read->changed());
  }
}

TEST_F(FileTexts, AreOfRegularFilesOnly) {
  EXPECT_FALSE(FileText::read(path("none")));
  EXPECT_FALSE(FileText::read(path("")));
  EXPECT_FALSE(FileText::read("/dev/zero"));
}

TEST_F(FileTexts, StayWhatTheyAreWhenGivenUp) {
  for (int const lines : {3, 200000}) {
    std::string const text = many_lines(lines);
    auto read = FileText::read(write("t", text));
    ASSERT_TRUE(read);
    for (std::size_t begin = 0; begin < text.size(); begin += 70001)
      read->give_up(begin, std::min(text.size(), begin + 70001));
    EXPECT_TRUE(read->view() == text);
    read->give_up(0, text.size());
    EXPECT_TRUE(std::move(*read).take() == text);
  }
}

TEST_F(FileTexts, OutliveAFileThatIsReplaced) {
  std::string const text = many_lines(200000);
  auto const read = FileText::read(write("t", text));
  read->give_up(0, text.size());
  std::filesystem::rename(write("other", "short"), path("t"));
  EXPECT_TRUE(read->view() == text);
  EXPECT_FALSE(read->changed());
}

TEST_F(FileTexts, TellThatTheFileWasWrittenTo) {
  std::string const text = many_lines(200000);
  auto const read = FileText::read(write("t", text));
  std::ofstream(path("t"), std::ios::binary | std::ios::app) << "more";
  EXPECT_TRUE(read->changed());
  EXPECT_TRUE(read->view() == text);
}

TEST_F(FileTexts, HaveLinesWhenGivenUp) {
  std::string const text = many_lines(200000);
  SourceFile const source("t", *FileText::read(write("t", text)));
  source.bytes().give_up(0, text.size());
  EXPECT_EQ(source.place(1234567).line, 123457);
  EXPECT_EQ(source.place(1234567).column, 8);
  EXPECT_EQ(source.line(123457), "   123457");
}

} // namespace
} // namespace abbe
