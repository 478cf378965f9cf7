// SPDX-License-Identifier: MIT
// Sources evaluated while they are parsed say and yield what they do when they are parsed whole.
#include "core_run.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace abbe::lang {
namespace {

namespace fs = std::filesystem;

/// Everything that can be seen of an evaluation.
std::string seen(fs::path const& file, std::size_t whole, std::size_t piece) {
  std::string out;
  EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  options.whole_text = whole;
  options.text_piece = piece;
  options.on_message = [&](std::string_view message) { out += message; };
  auto const evaluated = evaluate_file(file, options);
  for (auto const& diagnostic : evaluated.diagnostics) out += format(diagnostic) + "\n";
  out += evaluated.ok() ? dump_scene(evaluated.scene) : "no scene";
  return out;
}

TEST(StatementStreams, ShowNoDifferenceInAnyScene) {
  int files = 0;
  for (char const* folder : {"examples", "tests/golden/error", "tests/golden/eval",
                             "tests/golden/parse", "tests/povray/scenes"})
    for (auto const& entry : fs::directory_iterator(fs::path(ABBE_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".scn") continue;
      ++files;
      std::string const whole = seen(entry.path(), std::size_t{1} << 30, 1);
      for (std::size_t const piece : {1u, 300u})
        ASSERT_EQ(seen(entry.path(), 0, piece), whole) << entry.path() << " by " << piece;
    }
  EXPECT_GT(files, 200);
}

/// What a text says whole, checked to be the same statement by statement.
std::string both_ways(std::string const& text) {
  EvaluateOptions by_piece;
  by_piece.whole_text = 0;
  by_piece.text_piece = 1;
  std::string const whole = said(text);
  EXPECT_EQ(said(text, by_piece), whole) << text;
  return whole;
}

TEST(StatementStreams, SayNothingButTheErrorsOfSyntax) {
  std::string const later = "sphere { 0, 1 }\nbox { 0 1 ] }\n";
  std::string const alone = both_ways(later);
  EXPECT_NE(alone.find("E0"), std::string::npos);
  auto const without_places = [](std::string text) { return text.substr(text.find("error")); };
  for (char const* before :
       {"#debug \"said\"\n", "#warning \"warned\"\n", "#error \"given up\"\n",
        "sphere { 0, Unknown }\n", "#declare A = array[2]; #debug str(A[5], 0, 0)\n",
        "#include \"nowhere.inc\"\n", "#macro M() M() #end M()\n"})
    EXPECT_EQ(without_places(both_ways(before + later)).substr(0, 40),
              without_places(alone).substr(0, 40))
        << before;
}

TEST(StatementStreams, KeepWhatValuesReferTo) {
  EXPECT_EQ(both_ways("#macro M(a) #debug str(a, 0, 0) #end\n"
                      "#declare F = function(x) { x * 2 };\n"
                      "#declare P = 1; #declare Q = 2; #declare R = 3;\n"
                      "M(F(4)) #undef P #undef Q #undef R M(F(5))"),
            "810");
}

TEST(StatementStreams, ReadOnInABlockThatAnIfLeftOpen) {
  EXPECT_EQ(both_ways("#declare C = 1;\n#if (C) sphere { #end\n0, 1\nhollow\n#debug \"in it\"\n"
                      "no_shadow inverse\n#if (C) no_image } #end\n"),
            "in it");
}

class Folder : public testing::Test {
protected:
  // Each test of its own: they may run at the same time.
  Folder()
      : folder_(fs::path(testing::TempDir()) / ("statement_streams_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Folder() override { fs::remove_all(folder_); }
  fs::path write(char const* name, std::string const& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string both_ways(fs::path const& file) {
    std::string const whole = seen(file, std::size_t{1} << 30, 1);
    EXPECT_EQ(seen(file, 0, 1), whole);
    return whole;
  }

private:
  fs::path folder_;
};
using StatementStreamsOfIncludes = Folder;

TEST_F(StatementStreamsOfIncludes, AreReadTwice) {
  write("part.inc", "#debug str(N, 0, 0)\n#declare N = N + 1;\n#macro M() #debug \"m\" #end\n");
  auto const main = write("main.scn", "#declare N = 1;\n#include \"part.inc\"\nM()\n"
                                      "union { #include \"part.inc\" sphere { 0, 1 } M() }\n");
  EXPECT_EQ(both_ways(main).substr(0, 4), "1m2m");
}

TEST_F(StatementStreamsOfIncludes, ReportTheirErrorsBeforeThoseOfTheirStatements) {
  write("bad.inc", "#debug \"dropped\"\nsphere { 0, Unknown }\n#error \"stop\"\nbox { 0 1 ] }\n");
  auto const main = write("main.scn", "#debug \"kept\"\n#warning \"kept too\"\n"
                                      "union { #include \"bad.inc\" }\n#debug \"never\"\n");
  std::string const text = both_ways(main);
  EXPECT_EQ(text.find("dropped"), std::string::npos);
  EXPECT_EQ(text.find("Unknown"), std::string::npos);
  EXPECT_EQ(text.substr(0, 4), "kept");
  EXPECT_NE(text.find("kept too"), std::string::npos);
  EXPECT_NE(text.find("included from here"), std::string::npos);
}

TEST_F(StatementStreamsOfIncludes, GiveWayToErrorsOfTheFileThatIncludesThem) {
  write("fine.inc", "#debug \"dropped\"\n#error \"dropped\"\n");
  auto const main = write("main.scn", "#include \"fine.inc\"\nbox { 0 1 ] }\n");
  EXPECT_EQ(both_ways(main).find("dropped"), std::string::npos);
}

} // namespace
} // namespace abbe::lang
