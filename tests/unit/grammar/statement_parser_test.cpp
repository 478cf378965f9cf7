// SPDX-License-Identifier: MIT
// The pieces of StatementParser, put together, are what parse() gives: ground truth is parse().
#include "grammar/parse.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace abbe {
namespace {

namespace fs = std::filesystem;

std::string read(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Scenes and includes of the checkout, those with errors of syntax too.
std::vector<fs::path> texts() {
  std::vector<fs::path> files;
  for (char const* folder : {"examples", "stdlib", "tests/golden", "tests/povray/scenes"})
    for (auto const& entry : fs::recursive_directory_iterator(fs::path(ABBE_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".scn" || entry.path().extension() == ".inc")
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string written(ast::Document const& document, std::vector<Diagnostic> const& errors) {
  std::string out = dump_ast(document);
  for (auto const& error : errors) out += format(error) + "\n";
  return out;
}

/// The same tree and errors out of pieces of so many bytes.
std::string in_pieces(SourceFile const& source, std::size_t bytes) {
  StatementParser parser(source);
  ast::Document all{&source, {}};
  std::vector<Diagnostic> errors;
  ast::Items statements;
  while (!parser.at_end()) {
    auto piece = parser.next(bytes, statements);
    std::move(statements.begin(), statements.end(), std::back_inserter(all.items));
    std::move(piece.errors.begin(), piece.errors.end(), std::back_inserter(errors));
  }
  return written(all, errors);
}

TEST(StatementParser, GivesTheTreeAndTheErrorsOfTheWholeText) {
  auto const files = texts();
  ASSERT_GT(files.size(), 100u);
  for (auto const& file : files) {
    SourceFile const source(file.string(), read(file));
    Parsed const whole = parse(source);
    std::string const expected = written(whole.document, whole.errors);
    for (std::size_t const bytes : {1u, 100u, 5000u})
      ASSERT_EQ(in_pieces(source, bytes), expected) << file << ", pieces of " << bytes;
  }
}

TEST(StatementParser, GivesOneStatementAfterAnother) {
  SourceFile const source(
      "t.scn", "sphere { 0, 1 }\n// end of the first\nbox { 0, 1 }\n\n#declare A = 1;\n");
  StatementParser parser(source);
  ast::Items statements;
  std::vector<std::size_t> sizes;
  while (!parser.at_end()) {
    parser.next(1, statements);
    if (!statements.empty()) sizes.push_back(statements.size());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 1, 1}));
}

TEST(StatementParser, TellsWhatValuesWillReferTo) {
  SourceFile const source("t.scn", "sphere { 0, 1 } union { #if (1) #macro M() #end #end }"
                                   "#declare F = function(x) { x + 1 }; box { 0, 1 }");
  StatementParser parser(source);
  ast::Items statements;
  std::vector<bool> lasting;
  while (!parser.at_end()) {
    auto const piece = parser.next(1, statements);
    if (!statements.empty()) lasting.push_back(piece.lasting);
  }
  EXPECT_EQ(lasting, (std::vector<bool>{false, true, true, false}));
}

} // namespace
} // namespace abbe
