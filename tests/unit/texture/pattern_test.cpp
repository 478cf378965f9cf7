// SPDX-License-Identifier: MIT
#include "read_pattern.hpp"

#include <gmock/gmock.h>

namespace abbe::texture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Vec3 const p(0.3, 0.7, 1.9);

double value(std::string const& pattern, Vec3 const& point) {
  return read_pattern(pattern).evaluate(point);
}

// Section 22 of the language notes, to the printed digits.
TEST(Pattern, MatchesThePrintedTestVectors) {
  struct {
    char const* pattern;
    Vec3 point;
    double value;
    double tolerance;
  } const rows[] = {
      {"granite", p, 0.217032227569, 1e-12},
      {"wrinkles", p, 0.378132884196, 1e-12},
      {"agate", p, 0.710549065612, 1e-12},
      {"marble turbulence .3", p, 0.958908457784, 1e-12},
      {"wood turbulence .3", p, 0.290355121617, 1e-12},
      {"bozo turbulence .3", p, 0.405843423402, 1e-12},
      {"crackle", p, 0.046297815415, 1e-12},
      {"crackle solid", p, 0.536270412942, 1e-12},
      {"cells", p, 0.992742614821, 1e-12},
      {"dents", p, 0.049502854657, 1e-12},
      {"ripples", p, 0.415841202100, 1e-12},
      {"waves", p, 0.500904366959, 1e-12},
      {"leopard", {.3, .2, .1}, 0.039207, 5e-7},
      {"quilted", {.3, .2, .1}, 0.312365, 5e-7},
      {"spiral1 3", {.3, .2, .1}, 0.982591, 5e-7},
      {"gradient x sine_wave", {.3, 0, 0}, 0.975528, 5e-7},
      {"gradient x scallop_wave", {.3, 0, 0}, 0.809017, 5e-7},
      {"gradient x", {-.3, 0, 0}, .7, 1e-15},
      {"gradient x", {1.3, 0, 0}, .3, 1e-15},
      {"gradient x", {1, 0, 0}, 1, 0},
      {"gradient x", {-1.25, 0, 0}, .75001, 1e-15},
      {"spherical", {.3, 0, 0}, .7, 1e-15},
      {"boxed", {.3, .2, 0}, .7, 1e-15},
      {"brick", {.3, .2, .1}, 1, 0},
      {"brick", {4, 1.5, 2}, 0, 0},
      {"radial", {1, 0, 0}, 1, 1e-15},
      {"radial", {0, 0, 1}, .75, 1e-15},
      {"radial", {-1, 0, 0}, .5, 1e-15},
      {"radial", {0, 0, -1}, .24999, 1e-15},
      {"radial", {0, 3, 0}, .25, 0},
  };
  for (auto const& row : rows)
    EXPECT_NEAR(value(row.pattern, row.point), row.value, row.tolerance) << row.pattern;
}

TEST(Pattern, GradientWithFrequencyPhaseWaveAndScale) {
  PatternInstance g = read_pattern("gradient x frequency 2 phase .25 triangle_wave");
  g.mappings.push_back({Mat3(1.0 / 3), Vec3(0)});
  EXPECT_NEAR(g.evaluate(Vec3(.5, 0, 0)), 0.833333, 5e-7);
}

// The last written acts on the point first: translate 1, then scale 2, takes 3 to 3 / 2 - 1.
TEST(Pattern, MappingsActFromTheLastToTheFirst) {
  PatternInstance g = read_pattern("gradient x frequency 0");
  g.mappings.push_back({Mat3(1), Vec3(-1, 0, 0)});
  g.mappings.push_back({Mat3(0.5), Vec3(0)});
  EXPECT_EQ(g.evaluate(Vec3(3, 0, 0)), 0.5);
}

TEST(Pattern, TurbulenceActsAfterAllMappings) {
  PatternInstance scaled = read_pattern("bozo turbulence .5");
  scaled.mappings.push_back({Mat3(0.5), Vec3(0)});
  EXPECT_EQ(scaled.evaluate(p), value("bozo turbulence .5", p * 0.5));
}

// Seen in POV-Ray 3.7: checker rgb 0, rgb 1 with these is grey all over.
TEST(Pattern, WrittenWavesAndPhasesActOnListPatterns) {
  for (double x : {0.5, 1.5}) {
    EXPECT_NEAR(value("checker sine_wave", Vec3(x, 0.5, 0.5)), 0.5, 1e-15);
    EXPECT_NEAR(value("checker frequency 1 phase .3", Vec3(x, 0.5, 0.5)), 0.3, 1.1e-5);
    EXPECT_EQ(value("checker phase .3", Vec3(x, 0.5, 0.5)), value("checker", Vec3(x, 0.5, 0.5)));
  }
}

TEST(Pattern, CheckerPlanesBelongToTheUpperCell) {
  EXPECT_EQ(value("checker", Vec3(1, 0, 0)), 1);
  EXPECT_EQ(value("checker", Vec3(1 - 1e-11, 0, 0)), 1);
  EXPECT_EQ(value("checker", Vec3(1 - 1e-9, 0, 0)), 0);
  EXPECT_EQ(value("checker", Vec3(-1, 0, 0)), 1);
  EXPECT_EQ(value("checker", Vec3(0x1p40 + 1, 0, 0)), 1);
}

TEST(Pattern, ItemsMayStandBehindModifiers) {
  EXPECT_EQ(value("crackle turbulence .2 form <1,0,0> frequency 2 metric 1", p),
            value("crackle form <1,0,0> metric 1 turbulence .2 frequency 2", p));
}

TEST(Pattern, ReadItemLeavesTheOriginalAlone) {
  auto const kind = read_pattern("brick").pattern;
  WordParameters in("mortar 2");
  auto const changed = kind->read_item(in);
  ASSERT_TRUE(changed);
  Vec3 const q(1, 1, 1); // in the wide mortar, not in the narrow one
  EXPECT_EQ(changed->raw(q, {}), 0);
  EXPECT_EQ(kind->raw(q, {}), 1);
}

TEST(Pattern, KeywordsAreDistinctAndSorted) {
  auto const kinds = pattern_kinds();
  for (std::size_t i = 1; i < kinds.size(); ++i) EXPECT_LT(kinds[i - 1].keyword, kinds[i].keyword);
}

TEST(Pattern, DefaultMapsAscendAndListMapsHaveARowAnItem) {
  for (PatternKind const& kind : pattern_kinds()) {
    WordParameters in(kind.keyword == "gradient" ? "x" : "1");
    auto const pattern = kind.read(in);
    auto const map = pattern->default_map();
    ASSERT_FALSE(map.empty());
    for (std::size_t i = 1; i < map.size(); ++i) EXPECT_LE(map[i - 1].value, map[i].value);
    if (pattern->list_size() > 0) {
      EXPECT_EQ(map.size(), static_cast<std::size_t>(pattern->list_size()));
    }
  }
}

TEST(Pattern, ValuesStayFiniteForHugeAndTinyPoints) {
  for (PatternKind const& kind : pattern_kinds()) {
    WordParameters in(kind.keyword == "gradient" ? "<1,2,3>" : "3");
    PatternInstance instance;
    instance.pattern = kind.read(in);
    for (double size : {0.0, 1e-300, 1e-30, 1.0, 1e9, 1e15, 1e100})
      for (Vec3 const& d : {Vec3(1, -1, 1), Vec3(-1, 0, 0), Vec3(0, 0, -1), Vec3(1, 2, -3)})
        EXPECT_TRUE(std::isfinite(instance.evaluate(d * size))) << kind.keyword << ' ' << size;
  }
}

TEST(PatternErrors, AreReportedAndAHarmlessPatternIsReturned) {
  struct {
    char const* text;
    char const* report;
  } const rows[] = {
      {"gradient 0", "error E0381"},        {"brick brick_size <1,0,1>", "error E0382"},
      {"brick mortar -1", "error E0382"},   {"crackle metric 0", "error E0384"},
      {"crackle offset -1", "error E0384"}, {"bozo octaves 0", "warning E0383"},
      {"bozo octaves 11", "warning E0383"}, {"bozo noise_generator 4", "error E0300"},
  };
  for (auto const& row : rows) {
    WordParameters in(row.text);
    PatternInstance const instance = read_pattern(in);
    EXPECT_THAT(in.reports, ElementsAre(row.report)) << row.text;
    EXPECT_TRUE(std::isfinite(instance.evaluate(p))) << row.text;
  }
}

TEST(Modifiers, TurbulenceRecordExistsAsSoonAsOneOfItsWordsIsWritten) {
  for (char const* text : {"octaves 3", "omega .4", "lambda 3", "turbulence .2"}) {
    WordParameters in(text);
    PatternModifiers m;
    EXPECT_TRUE(read_modifier(in, m));
    EXPECT_TRUE(m.turbulence.has_value()) << text;
    EXPECT_TRUE(in.at_end());
  }
}

TEST(Modifiers, LeaveUnknownWordsAlone) {
  WordParameters in("scale 2");
  PatternModifiers m;
  EXPECT_FALSE(read_modifier(in, m));
  EXPECT_TRUE(in.accept("scale"));
  EXPECT_THAT(in.reports, IsEmpty());
}

} // namespace
} // namespace abbe::texture
