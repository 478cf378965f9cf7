// SPDX-License-Identifier: MIT
// POV-Ray's own scenes and includes (Debian packages povray-examples, povray-includes) are the
// ground truth for what must parse, and the seed for fuzzing.
#include "grammar/parse.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>

namespace abbe {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> corpus() {
  std::vector<fs::path> files;
  // Debian's examples directory links to /usr/share/povray-3.7/scenes.
  for (char const* root : {"/usr/share/povray-3.7", "/usr/share/povray"}) {
    if (!fs::exists(root)) continue;
    for (auto const& entry :
         fs::recursive_directory_iterator(root, fs::directory_options::follow_directory_symlink))
      if (entry.is_regular_file()
          && (entry.path().extension() == ".pov" || entry.path().extension() == ".inc"))
        files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string read(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Everything a parse promises whatever the text: it returns, errors have places inside the text.
void check(std::string text) {
  SourceFile const source("fuzz", std::move(text));
  Parsed const parsed = parse(source);
  ASSERT_LE(parsed.errors.size(), 20u);
  for (auto const& error : parsed.errors) {
    ASSERT_TRUE(error.span.valid());
    ASSERT_LE(error.span.begin, error.span.end);
    ASSERT_LE(error.span.end, source.text().size());
    ASSERT_FALSE(format(error).empty());
  }
}

TEST(Corpus, AllButTheTemplateParse) {
  auto const files = corpus();
  if (files.empty()) GTEST_SKIP() << "povray-examples and povray-includes are not installed";
  // Debian 12: 396 scenes in povray-examples and 81 includes. Only the includes: still worth a
  // test.
  std::printf("[ corpus   ] %zu files\n", files.size());
  for (auto const& file : files) {
    SourceFile const source(file.string(), read(file));
    Parsed const parsed = parse(source);
    // A form to fill in, with `...` for the names: POV-Ray cannot parse it either.
    bool const is_template = file.filename() == "__empty.pov";
    EXPECT_EQ(parsed.errors.empty(), !is_template)
        << (parsed.errors.empty() ? file.string() : format(parsed.errors.front()));
  }
}

TEST(Fuzz, TruncatedFilesEndInDiagnostics) {
  auto const files = corpus();
  if (files.empty()) GTEST_SKIP() << "povray-examples and povray-includes are not installed";
  std::mt19937 random(20240601);
  for (int i = 0; i < 400; ++i) {
    std::string text = read(files[random() % files.size()]);
    if (text.empty()) continue;
    text.resize(std::min<std::size_t>(random() % text.size(), 20000));
    check(std::move(text));
  }
}

TEST(Fuzz, RandomBytesAndTokensEndInDiagnostics) {
  static constexpr char const* tokens[] = {
      "{",   "}",    "(",       ")",       "<",        ">",         "[",
      "]",   "#if(", "#else ",  "#end ",   "#case(1)", "#macro M(", "#declare ",
      "A",   "=",    "1.5",     ",",       ";",        "\"",        "/*",
      "*/",  "//",   "\n",      "sphere{", "texture{", "function{", "array[",
      ".",   ".x",   "-",       "+",       "!",        "?",         ":",
      "&",   "#",    "#write(", "#while(", "#for(",    "#include ", "rgb ",
      "sin("};
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    std::string bytes;
    for (auto n = random() % 300; n > 0; --n) bytes += static_cast<char>(random() % 256);
    check(std::move(bytes));
    std::string text;
    for (auto n = random() % 120; n > 0; --n) text += tokens[random() % std::size(tokens)];
    check(std::move(text));
  }
}

} // namespace
} // namespace abbe
