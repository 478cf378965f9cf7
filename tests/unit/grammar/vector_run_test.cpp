// SPDX-License-Identifier: MIT
// Long lists of literal vectors are one node of the tree and read as so many items.
#include "grammar/parse.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace abbe {
namespace {

/// A block of vectors, and the dump that it must have.
struct List {
  std::string text = "b {";
  std::string dump;
  void add(std::string const& vector, std::string const& values, std::string const& behind) {
    dump += fmt::format("  LiteralVector [{}-{}] {}\n", text.size(), text.size() + vector.size(),
                        values);
    text += vector + behind;
  }
  std::size_t items() const {
    SourceFile const source("t.scn", text + "}");
    Parsed const parsed = parse(source);
    EXPECT_TRUE(parsed.errors.empty());
    std::string const all = dump_ast(parsed.document);
    EXPECT_EQ(all.substr(all.find('\n') + 1), dump);
    return ast::get_if<ast::Block>(parsed.document.items[0])->items.size();
  }
};

TEST(VectorRun, DumpsAsItsVectorsHoweverMany) {
  for (int const count : {1, 15, 16, 100}) {
    List list;
    for (int i = 0; i < count; ++i)
      list.add(fmt::format("< {}, /* > */ -2.5,3>", i), fmt::format("{} -2.5 3", i),
               i % 3 == 0 ? "\n" : " ,,// <\n");
    EXPECT_EQ(list.items(), count < 16 ? static_cast<std::size_t>(count) : 1u);
  }
}

TEST(VectorRun, EndsWhereTheSizeChanges) {
  List list;
  for (int i = 0; i < 20; ++i) list.add("<1,2>", "1 2", ",");
  for (int i = 0; i < 30; ++i) list.add("<1,2,3>", "1 2 3", ",");
  EXPECT_EQ(list.items(), 2u);
}

TEST(VectorRun, LeavesOperatorsAndOtherItemsAlone) {
  std::string text = "b {";
  for (int i = 0; i < 40; ++i) text += i % 20 == 19 ? "<1,2,3>*2, " : "<1,2,3>, ";
  SourceFile const source("t.scn", text + "<1,A,3> }");
  Parsed const parsed = parse(source);
  EXPECT_TRUE(parsed.errors.empty());
  auto const& items = ast::get_if<ast::Block>(parsed.document.items[0])->items;
  ASSERT_EQ(items.size(), 5u);
  EXPECT_NE(ast::get_if<ast::Binary>(items[1]), nullptr);
  EXPECT_NE(ast::get_if<ast::Binary>(items[3]), nullptr);
  EXPECT_NE(ast::get_if<ast::Vector>(items[4]), nullptr);
}

TEST(VectorRun, SaysWhatIsWrongInIt) {
  std::string text = "b {\n";
  for (int i = 0; i < 20; ++i) text += "<1,2,3>,\n";
  SourceFile const source("t.scn", text + "<1,2..5,3> }");
  Parsed const parsed = parse(source);
  ASSERT_EQ(parsed.errors.size(), 1u);
  EXPECT_EQ(parsed.errors[0].code, "E0105");
  EXPECT_EQ(source.place(parsed.errors[0].span.begin).line, 22);
}

} // namespace
} // namespace abbe
