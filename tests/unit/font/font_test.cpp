// SPDX-License-Identifier: MIT
// Expected numbers: DejaVu Sans 2.37, of which abbe's own font is a part, as its tables have them.
#include "font/font.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace abbe::font {
namespace {

std::string bytes_of(std::string const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::shared_ptr<Font const> opened(std::string const& path) {
  auto font = Font::open(bytes_of(path), path);
  EXPECT_TRUE(font) << path;
  return font ? *font : nullptr;
}
std::shared_ptr<Font const> own() {
  return opened(std::string(ABBE_STDLIB_DIR) + "/fonts/abbe-sans.ttf");
}

/// Twice the area that a closed curve goes round, by Green's theorem; exact for lines and curves of
/// degree two and three.
double area_of(std::vector<Contour> const& outline) {
  auto const cross = [](Vec2 const& a, Vec2 const& b) { return a.x * b.y - a.y * b.x; };
  double sum = 0;
  for (Contour const& contour : outline) {
    for (Segment const& s : contour) {
      if (s.size() == 2) sum += cross(s[0], s[1]) / 2;
      if (s.size() == 3)
        sum += (2 * cross(s[0], s[1]) + cross(s[0], s[2]) + 2 * cross(s[1], s[2])) / 6;
      if (s.size() == 4)
        sum += (6 * cross(s[0], s[1]) + 3 * cross(s[0], s[2]) + cross(s[0], s[3])
                + 3 * cross(s[1], s[2]) + 3 * cross(s[1], s[3]) + 6 * cross(s[2], s[3]))
               / 20;
    }
  }
  return sum;
}

TEST(Font, MeasuresAreThoseOfItsTables) {
  auto const font = own();
  ASSERT_TRUE(font);
  EXPECT_EQ(font->units_per_em(), 2048);
  std::uint32_t const a = font->glyph('A'), v = font->glyph('V'), h = font->glyph('H');
  EXPECT_EQ(font->advance(a), 1401);
  EXPECT_EQ(font->left_bearing(a), 16);
  EXPECT_EQ(font->left_bearing(h), 201);
  EXPECT_EQ(font->kerning(a, v), -131);
  EXPECT_EQ(font->kerning(a, a), 57);
  EXPECT_EQ(font->kerning(h, h), 0);
  EXPECT_EQ(font->glyph(U'\U0001f600'), 0U);
  EXPECT_TRUE(font->outline(font->glyph(' ')).empty());
}

TEST(Font, OutlinesGoRoundTheAreaOfTheLetter) {
  auto const font = own();
  ASSERT_TRUE(font);
  // A bar of 184 by 1556 units; two bars of 202 by 1493 and one of 734 by 170 between them.
  EXPECT_EQ(std::fabs(area_of(font->outline(font->glyph('l')))), 184 * 1556);
  EXPECT_EQ(std::fabs(area_of(font->outline(font->glyph('H')))), 2 * 202 * 1493 + 734 * 170);
}

TEST(Font, CubicAndQuadraticOutlinesOfOneLetterAgree) {
  std::string const corpus = std::string(ABBE_SOURCE_DIR) + "/tests/fuzz/corpus/font/small";
  auto const quadratic = opened(corpus + ".ttf"), cubic = opened(corpus + ".otf");
  ASSERT_TRUE(quadratic && cubic);
  for (char32_t const letter : {U'A', U'V', U'l', U'\u00e4'}) {
    std::uint32_t const q = quadratic->glyph(letter), c = cubic->glyph(letter);
    double const area = std::fabs(area_of(quadratic->outline(q)));
    ASSERT_GT(area, 0);
    // The control points of the cubic one are rounded to whole units.
    EXPECT_NEAR(std::fabs(area_of(cubic->outline(c))), area, 2e-3 * area);
    EXPECT_EQ(quadratic->advance(q), cubic->advance(c));
  }
}

TEST(Font, WhatIsNoFontIsAnErrorWithItsName) {
  for (std::string const& bytes : {std::string(), std::string("no font at all")}) {
    auto const font = Font::open(bytes, "letters.ttf");
    ASSERT_FALSE(font);
    EXPECT_EQ(font.error().code, "E0518");
    EXPECT_NE(font.error().message.find("'letters.ttf'"), std::string::npos);
  }
  std::string const whole = bytes_of(std::string(ABBE_STDLIB_DIR) + "/fonts/abbe-sans.ttf");
  EXPECT_FALSE(Font::open(whole.substr(0, 300), "cut.ttf"));
}

} // namespace
} // namespace abbe::font
