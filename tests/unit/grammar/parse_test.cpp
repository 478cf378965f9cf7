// SPDX-License-Identifier: MIT
// Expected trees follow pov-language.md (section 2.2 precedences, 21.3 branches, 19 functions),
// which quotes the POV-Ray 3.7 manual and tests against the program.
#include "grammar/parse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace abbe {
namespace {

struct Text {
  SourceFile source;
  Parsed parsed;
  explicit Text(std::string text) : source("t.scn", std::move(text)), parsed(parse(source)) {}
  /// The dump without spans, one line: `Kind text; ` and parentheses for the nesting.
  std::string shape() const {
    std::string const dump = dump_ast(parsed.document);
    std::string out;
    std::size_t depth = 0;
    for (std::size_t at = 0; at < dump.size();) {
      std::size_t const end = dump.find('\n', at);
      std::string line = dump.substr(at, end - at);
      at = end + 1;
      std::size_t const level = line.find_first_not_of(' ') / 2;
      line = line.substr(level * 2);
      if (auto const open = line.find(" ["); open != std::string::npos)
        line.erase(open, line.find(']') + 1 - open);
      if (out.empty())
        out = line;
      else if (level > depth)
        out += "(" + line;
      else
        out += std::string(depth - level, ')') + ", " + line;
      depth = level;
    }
    return out + std::string(depth, ')');
  }
};

std::string shape(std::string text) {
  Text const t(std::move(text));
  return t.parsed.errors.empty() ? t.shape() : format(t.parsed.errors.front());
}
std::string first_error(std::string text) {
  Text const t(std::move(text));
  return t.parsed.errors.empty() ? "none" : format(t.parsed.errors.front());
}

TEST(Precedence, ProductBindsCloserThanSum) {
  EXPECT_EQ(shape("1+2*3"), "Binary +(Number 1, Binary *(Number 2, Number 3))");
}
TEST(Precedence, UnaryMinusBindsCloserThanProductAndFoldsIntoLiterals) {
  EXPECT_EQ(shape("-A*2"), "Binary *(Unary -(Name A), Number 2)");
  EXPECT_EQ(shape("- 2.5"), "Number -2.5");
}
TEST(Precedence, MemberBindsToOnePrimary) {
  EXPECT_EQ(shape("-V.x"), "Unary -(Member x(Name V))");
  EXPECT_EQ(shape("F(1).red"), "Member red(Call F(argument:(Number 1)))");
}
TEST(Precedence, AndOrShareOneLevelInsideParentheses) {
  EXPECT_EQ(shape("(1|1&0)"), "Paren(Binary &(Binary |(Number 1, Number 1), Number 0))");
}
TEST(Precedence, OrIsLowestInFunctions) {
  EXPECT_EQ(shape("function { 1|1&0 }"),
            "Function(body:(Binary |(Number 1, Binary &(Number 1, Number 0))))");
}
TEST(Precedence, ParenthesesOfFunctionsHoldWhatFunctionsHold) {
  EXPECT_EQ(shape("function { (1|1&0) }"),
            "Function(body:(Paren(Binary |(Number 1, Binary &(Number 1, Number 0)))))");
  EXPECT_EQ(
      shape("function { (min(x=2, 1)) }"),
      "Function(body:(Paren(Call min reserved(argument:(Binary =(Name x reserved, Number 2)), "
      "argument:(Number 1)))))");
}
TEST(Precedence, RelationsGroupFromTheRightInFunctions) {
  EXPECT_EQ(shape("function { a<b<c }"),
            "Function(body:(Binary <(Name a, Binary <(Name b, Name c))))");
  EXPECT_EQ(shape("(a<b<c)"), "Paren(Binary <(Binary <(Name a, Name b), Name c))");
}
TEST(Precedence, BareExpressionsStopBeforeLess) {
  EXPECT_EQ(shape("sellmeier <1,2,3>, <4,5,6>"),
            "Name sellmeier, LiteralVector 1 2 3, LiteralVector 4 5 6");
}
TEST(Expressions, ChoiceNeedsNoParentheses) {
  EXPECT_EQ(shape("scale A ? 1 : 2"), "Word scale, Conditional(Name A, Number 1, Number 2)");
}
TEST(Expressions, WordThenMinusIsNoSubtraction) {
  EXPECT_EQ(shape("translate -x"), "Word translate, Unary -(Name x reserved)");
  EXPECT_EQ(shape("a -b"), "Binary -(Name a, Name b)");
}
TEST(Expressions, CommaLessVectorsAreGreedy) {
  EXPECT_EQ(shape("<1 -2 3>"), "Vector(Binary -(Number 1, Number 2), Number 3)");
  EXPECT_EQ(shape("<1 2 3>"), "LiteralVector 1 2 3");
}
TEST(Expressions, ReservedOperandsAreNotCalled) {
  EXPECT_EQ(shape("rotate x (2)"), "Word rotate, Name x reserved, Paren(Number 2)");
}
TEST(Expressions, FunctionWordWithoutParenthesisIsAWord) {
  EXPECT_EQ(shape("julia_fractal { <0,0,0,1> quaternion sqr }"),
            "Block julia_fractal reserved(LiteralVector 0 0 0 1, Word quaternion, Word sqr)");
}
TEST(Numbers, AreTheNearestDoubles) {
  // 17 digits and exponents leave the exact fast path; decimal literals of C++ are the ground
  // truth.
  for (auto const& [text, value] : {std::pair{"0.1", 0.1},
                                    {"123456.789e-3", 123456.789e-3},
                                    {"3.14159265358979323846", 3.14159265358979323846},
                                    {"9007199254740993", 9007199254740993.0},
                                    {"2.2250738585072011e-308", 2.2250738585072011e-308},
                                    {".5", .5},
                                    {"12.", 12.},
                                    {"1.e3", 1e3}}) {
    Text const t(text);
    ASSERT_EQ(t.parsed.document.items.size(), 1u) << text;
    auto const* number = ast::get_if<ast::Number>(t.parsed.document.items[0]);
    ASSERT_NE(number, nullptr) << text;
    EXPECT_EQ(number->value, value) << text;
  }
}
TEST(Strings, ResolveEscapesButKeepPathsRaw) {
  Text const t(R"(#debug "a\tb\u00e9\"" png "maps\earth.png" #include "a\b.inc")");
  ASSERT_TRUE(t.parsed.errors.empty()) << format(t.parsed.errors[0]);
  auto const& items = t.parsed.document.items;
  auto const* debug = ast::get_if<ast::Directive>(items[0]);
  EXPECT_EQ(ast::get_if<ast::String>(debug->arguments[0])->text, "a\tb\xc3\xa9\"");
  EXPECT_EQ(ast::get_if<ast::String>(items[2])->raw, R"(maps\earth.png)");
  auto const* include = ast::get_if<ast::Directive>(items[3]);
  EXPECT_EQ(ast::get_if<ast::String>(include->arguments[0])->raw, R"(a\b.inc)");
}
TEST(Declare, EndsAtSemicolonOrAfterOneOperand) {
  EXPECT_EQ(shape("#declare A = sphere{0,1} box{0,1}"),
            "Declare declare(Name A, value:(Block sphere reserved(Number 0, Number 1))), "
            "Block box reserved(Number 0, Number 1)");
  EXPECT_EQ(shape("#local C = White filter .5;"),
            "Declare local ;(Name C, value:(Name White, Word filter, Number 0.5))");
  EXPECT_EQ(shape("#declare T = texture{A} texture{B} sphere{}"),
            "Declare declare(Name T, value:(Block texture reserved(Name A), Block texture "
            "reserved(Name B))), Block sphere reserved");
  EXPECT_EQ(shape("#declare deprecated once \"old\" N[2] = 1;"),
            "Declare declare deprecated once \"old\" ;(Index N(Number 2), value:(Number 1))");
}
TEST(Directives, MessagesNameWhatIsExpectedInWords) {
  // A mark for each token in turn: what is expected instead is never a type of the parser's.
  std::vector<std::string> const tokens = {
      "#declare", "deprecated", "once",    "\"s\"", "A",        "=",      "array",    "[",
      "2",        "]",          "{",       "1",     "2",        "}",      "#for",     "(",
      "I",        ",",          "0",       ",",     "1",        ",",      "1",        ")",
      "#end",     "#while",     "(",       "0",     ")",        "#end",   "#switch",  "(",
      "1",        ")",          "#case",   "(",     "1",        ")",      "#range",   "(",
      "1",        ",",          "2",       ")",     "#else",    "#end",   "#if",      "(",
      "1",        ")",          "#elseif", "(",     "1",        ")",      "#else",    "#end",
      "#ifdef",   "(",          "A",       ")",     "#end",     "#macro", "M",        "(",
      "B",        ",",          "C",       ")",     "B",        "#end",   "#fopen",   "H",
      "\"f\"",    "write",      "#write",  "(",     "H",        ",",      "1",        ")",
      "#fclose",  "H",          "#undef",  "A",     "#include", "\"f\"",  "#version", "3.7",
      ";",        "#default",   "{",       "}",     "#declare", "F",      "=",        "function",
      "(",        "x",          ")",       "{",     "x",        "}"};
  for (char const* const mark : {",", ")", "=", ">"}) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      std::string text;
      for (std::size_t k = 0; k < tokens.size(); ++k) text += (k == i ? mark : tokens[k]) + " ";
      EXPECT_EQ(first_error(text).find("boost"), std::string::npos) << text;
    }
  }
}
TEST(Directives, MayStandWithoutHashAtTopLevel) {
  EXPECT_EQ(shape("version 3.7; default { }"),
            "Directive version(Number 3.7), Directive default(Block)");
}
TEST(Directives, MayStandInParenthesesVectorsAndArguments) {
  EXPECT_EQ(shape("(#if(a) 1 #else 2 #end)"),
            "Paren(If(Branch if(Paren(Name a), Number 1), Branch else(Number 2)))");
  EXPECT_EQ(shape("<1, #if(a) 2 #end>"),
            "Vector(Number 1, If(Branch if(Paren(Name a), Number 2)))");
}
TEST(Branches, OpenBlockContinuesBehindEnd) {
  EXPECT_EQ(shape("#if(M) merge { #else union { #end A }"),
            "If with tail(Branch if(Paren(Name M), Block merge reserved open), Branch else(Block "
            "union reserved open), tail:(Name A))");
}
TEST(Branches, LooseBracketsAreKept) {
  EXPECT_EQ(shape("#if(M) merge { #end A #if(M) } #end"),
            "If(Branch if(Paren(Name M), Block merge reserved open)), Name A, If(Branch "
            "if(Paren(Name M), Punctuation }))");
}
TEST(Branches, WhatIsNotWholeIsText) {
  EXPECT_EQ(shape("#macro M() union { #end"), "Macro M()(Text)");
  EXPECT_EQ(shape("#if(a) 1 ] #else 2 #end"),
            "If(Branch if(Paren(Name a), Text), Branch else(Number 2))");
  EXPECT_EQ(shape("#macro M() #for(I, 0, 1) } #end A #end"),
            "Macro M()(For I(Number 0, Number 1, body:(Text)), Name A)");
  EXPECT_EQ(first_error("#macro M() \"").substr(0, 25), "t.scn:1:12: error[E0103]:");
  EXPECT_EQ(first_error("#macro M() { #if(a) #end").substr(0, 25), "t.scn:1:25: error[E0111]:");
}
TEST(Branches, TextsAreReadItemByItem) {
  SourceFile const source("t.scn", "union { ; a -1 } #declare B = sphere {");
  Span const text{&source, 0, static_cast<std::uint32_t>(source.text().size())};
  std::string ends;
  for (std::uint32_t at = 0;;) {
    LooseItem const item = parse_loose(text, at, false);
    ASSERT_FALSE(item.error.has_value());
    if (item.items.empty()) break;
    ends += std::to_string(at = item.end) + " ";
  }
  // union {, ;, a -1, }, #declare B =, sphere {
  EXPECT_EQ(ends, "7 9 14 16 29 38 ");
}
TEST(Spans, CoverTheNodeWithoutBlanks) {
  Text const t(" \n sphere { <0, 1, 2> , R } // end");
  auto const span = ast::span_of(t.parsed.document.items.at(0));
  EXPECT_EQ(span.text(), "sphere { <0, 1, 2> , R }");
}
TEST(Errors, PointAtTheTokenAndNameTheOpener) {
  EXPECT_EQ(first_error("sphere { <0,1,2>, 1\n  )\n"),
            "t.scn:2:3: error[E0111]: expected '}' to close the block, found ')'\n"
            "    )\n    ^\nt.scn:1:8: note: the block is opened here");
}
TEST(Errors, AreAllReportedAndTheRestIsParsed) {
  Text const t("sphere { ) }\nbox { 0, 1 }\n#foo\nunion {\n  cone { ] }\n}\nplane { y, 0 }\n");
  EXPECT_EQ(t.parsed.errors.size(), 3u);
  EXPECT_EQ(
      t.shape(),
      "Block box reserved(Number 0, Number 1), Block plane reserved(Name y reserved, Number 0)");
}
TEST(Errors, AreTwentyAtMost) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "sphere { ) }\n";
  EXPECT_EQ(Text(text).parsed.errors.size(), 20u);
}
TEST(Limits, NestingIsBounded) {
  for (char const* open :
       {"(", "{", "<", "[", "f(", "sphere{", "#if(1) ", "function{(", "1?", "a[", "#macro a() "}) {
    std::string text;
    for (int i = 0; i < 20000; ++i) text += open;
    Text const t(text);
    ASSERT_FALSE(t.parsed.errors.empty()) << open;
    EXPECT_EQ(t.parsed.errors[0].code, "E0701") << open;
  }
}
TEST(Limits, LongChainsAreBounded) {
  for (char const* link : {"1+", "-", "1*", "(1)<"}) {
    std::string text = "(";
    for (int i = 0; i < 100000; ++i) text += link;
    Text const t(text + "1)");
    ASSERT_FALSE(t.parsed.errors.empty()) << link;
    EXPECT_EQ(t.parsed.errors[0].code, "E0702") << link;
  }
}
TEST(Tokens, AreDumpedWithPlaces) {
  EXPECT_EQ(dump_tokens(SourceFile("t.scn", "# declare A=<1.5>; // c\n\"x\" sin \x80")),
            "1:1 directive # declare\n1:11 name A\n1:12 punctuation =\n1:13 punctuation <\n"
            "1:14 number 1.5\n1:17 punctuation >\n1:18 punctuation ;\n2:1 string \"x\"\n"
            "2:5 function sin\n2:9 unknown \x80\n");
}

// Bytes: POV-Ray 3.7 reads all of these alike, but takes a NUL for a blank.
TEST(Bytes, LinesEndInEverySystemsWay) {
  std::string const expected = shape("sphere { 0, 1 } // a\nbox { 0, 1 }\n");
  for (std::string const end : {"\r", "\r\n", "\n"}) {
    EXPECT_EQ(shape("sphere { 0, 1 } // a" + end + "box { 0, 1 }" + end), expected);
    std::string const wrong = "// a" + end + end + "/* b" + end + "*/ #declare 3";
    EXPECT_TRUE(first_error(wrong).starts_with("t.scn:4:13: error[E0110]")) << first_error(wrong);
    EXPECT_NE(first_error(wrong).find("\n  */ #declare 3\n"), std::string::npos);
  }
}
TEST(Bytes, AMarkAtTheBeginningIsNoText) {
  EXPECT_EQ(shape("\xef\xbb\xbf-V.x"), shape("-V.x"));
  EXPECT_EQ(dump_tokens(SourceFile("t.scn", "\xef\xbb\xbf A")), "1:2 name A\n");
  EXPECT_TRUE(first_error("A \xef\xbb\xbf").starts_with("t.scn:1:3: error[E0101]"));
}
TEST(Bytes, AboveAsciiStandInCommentsAndStrings) {
  EXPECT_EQ(shape("/* \xe9\xff */ \"\xe9\" // \xc3\xa9"), "String \"\xe9\"");
}
/// The text with NULs where it has '@'.
std::string with_nuls(std::string text) {
  std::replace(text.begin(), text.end(), '@', '\0');
  return text;
}
TEST(Bytes, NulIsAnErrorOutsideOfComments) {
  EXPECT_EQ(shape(with_nuls("/* @ */ A // @")), "Name A");
  std::string const bare = first_error(with_nuls("A\n @@ B"));
  EXPECT_TRUE(bare.starts_with("t.scn:2:2-3: error[E0101]: the byte 0x00")) << bare;
  std::string const quoted = first_error(with_nuls("A\n \"b@\""));
  EXPECT_TRUE(quoted.starts_with("t.scn:2:4: error[E0101]: the byte 0x00")) << quoted;
}
TEST(Bytes, WideTextsAreNamed) {
  std::string const wide = first_error(with_nuls("\xff\xfe"
                                                 "A@"));
  EXPECT_TRUE(wide.starts_with("t.scn:1:1: error[E0101]: this text is UTF-16")) << wide;
}
TEST(Calls, OfElementsOfArrays) {
  EXPECT_EQ(shape("F[1](2)"), "Call F(Index F(Number 1), argument:(Number 2))");
}

} // namespace
} // namespace abbe
