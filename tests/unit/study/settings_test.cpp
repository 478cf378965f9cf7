// SPDX-License-Identifier: MIT
#include "study/settings.hpp"

#include <gmock/gmock.h>
#include <set>

namespace abbe::study {
namespace {

using testing::ElementsAre;

TEST(FillWords, SplitsAtBlanksAndKeepsQuotedWordsWhole) {
  EXPECT_THAT(fill_words("--dispersion 'hero {}' --bands 8", "4"),
              ElementsAre("--dispersion", "hero 4", "--bands", "8"));
}

TEST(Families, HaveNamesOfTheirOwnAndWordsWithTheValue) {
  std::set<std::string_view> names;
  for (auto const& family : families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_NE(family.words.find("{}"), std::string_view::npos) << family.name;
    EXPECT_EQ(find_family(family.name), &family);
  }
}

TEST(MakeSettings, CrossesModesBandsAndAntiAliasing) {
  auto const settings = make_settings({{"deterministic"}, {4, 8}, {"off", "3/0"}});
  ASSERT_TRUE(settings);
  ASSERT_EQ(settings->size(), 4u);
  EXPECT_EQ((*settings)[1].name, "deterministic 8");
  EXPECT_EQ((*settings)[3].name, "deterministic 8, aa 3/0");
  EXPECT_THAT((*settings)[3].words,
              ElementsAre("--dispersion", "deterministic", "--representation", "bands", "--bands",
                          "8", "--aa", "3", "--aa-threshold", "0"));
}

TEST(MakeSettings, NamesTheModesWhenOneIsUnknown) {
  auto const settings = make_settings({{"determinstic"}, {8}, {"off"}});
  ASSERT_FALSE(settings);
  EXPECT_THAT(settings.error().message,
              testing::AllOf(testing::HasSubstr("did you mean 'deterministic'"),
                             testing::HasSubstr("stochastic")));
}

TEST(ParseSampling, RefusesWhatRenderWouldRefuse) {
  for (char const* good : {"off", "1", "64", "3/0", "4/0.25"}) EXPECT_TRUE(parse_sampling(good));
  for (char const* bad : {"", "0", "65", "2.5", "3/", "3/4", "on", "3/x"})
    EXPECT_FALSE(parse_sampling(bad)) << bad;
}

} // namespace
} // namespace abbe::study
