// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "optics/agf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace abbe::optics {
namespace {

std::string sample() {
  std::ifstream stream(ABBE_SOURCE_DIR "/tests/data/optics/sample.agf", std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

TEST(Agf, ReadsCoefficientsRangeAndTransmittance) {
  auto const catalogue = read_agf(sample(), "TEST");
  EXPECT_TRUE(catalogue.problems.empty());
  auto const& glasses = catalogue.glasses;
  ASSERT_EQ(glasses.size(), 3u);
  auto const& bk7 = *glasses.at(0);
  EXPECT_EQ(bk7.full_name(), "TEST/N-BK7");
  EXPECT_EQ(bk7.status(), "preferred");
  EXPECT_NEAR(*bk7.nd(), 1.5168, 1e-5);
  EXPECT_NEAR(*bk7.vd(), 64.17, 5e-3);
  EXPECT_EQ(bk7.range_nm().lo_nm, 300);
  EXPECT_NEAR(std::exp(-25 * bk7.absorption_per_mm(400)), 0.994, 1e-12);
  EXPECT_NEAR(std::exp(-10 * bk7.absorption_per_mm(320)), 0.77, 1e-12);
  EXPECT_NEAR(*glasses.at(1)->nd(), *glasses.at(1)->printed_nd(), 1e-5);
  EXPECT_FALSE(glasses.at(1)->absorbs());
}

TEST(Agf, EveryFormulaComputesItsEquation) {
  // Zemax manual, "Glass catalogs": each formula written out at 0.5 um.
  double const w = 0.5, w2 = 0.25, w4 = w2 * w2;
  double const l = 1 / (w2 - 0.028);
  struct Case {
    int id;
    char const* cd;
    double n2;
  } const cases[] = {
      {1, "2.2 -0.01 0.01 2e-4 1e-5 1e-6",
       2.2 - 0.01 * w2 + 0.01 / w2 + 2e-4 / w4 + 1e-5 / (w4 * w2) + 1e-6 / (w4 * w4)},
      {2, "1.1 0.01 0.2 0.02 1 100",
       1 + 1.1 * w2 / (w2 - 0.01) + 0.2 * w2 / (w2 - 0.02) + w2 / (w2 - 100)},
      {3, "1.5 3e-3 1e-4 -1e-2 1e-3 1e-4",
       std::pow(1.5 + 3e-3 * l + 1e-4 * l * l - 1e-2 * w2 + 1e-3 * w4 + 1e-4 * w4 * w2, 2)},
      {4, "0.2 1.1 0.1 0.5 10", 1 + 0.2 + 1.1 * w2 / (w2 - 0.01) + 0.5 / (w2 - 100)},
      {5, "1.5 0.01 0.001", std::pow(1.5 + 0.01 / w + 0.001 / std::pow(w, 3.5), 2)},
      {6, "1 0.01 0.2 0.02 1 100 0.1 200",
       1 + 1 * w2 / (w2 - 0.01) + 0.2 * w2 / (w2 - 0.02) + w2 / (w2 - 100) + 0.1 * w2 / (w2 - 200)},
      {7, "2.2 0.01 0.02 0.03", 2.2 + 0.01 / (w2 - 0.02) - 0.03 * w2},
      {8, "2.2 0.01 0.02 0.03", 2.2 + 0.01 * w2 / (w2 - 0.02) - 0.03 * w2},
      {9, "1.5 0.7 0.02 0.9 100", 1.5 + 0.7 * w2 / (w2 - 0.02) + 0.9 * w2 / (w2 - 100)},
      {10, "2.2 -0.01 0.01 2e-4 1e-5 1e-6 1e-7 1e-8",
       2.2 - 0.01 * w2 + 0.01 / w2 + 2e-4 / w4 + 1e-5 / (w4 * w2) + 1e-6 / (w4 * w4)
           + 1e-7 * std::pow(w, -10) + 1e-8 * std::pow(w, -12)},
      {11, "1 0.01 0.2 0.02 1 100 0.1 200 0.1 300",
       1 + 1 * w2 / (w2 - 0.01) + 0.2 * w2 / (w2 - 0.02) + w2 / (w2 - 100) + 0.1 * w2 / (w2 - 200)
           + 0.1 * w2 / (w2 - 300)},
      {12, "2.2 -0.01 0.01 2e-4 1e-5 1e-6 1e-3 1e-4",
       2.2 - 0.01 * w2 + 0.01 / w2 + 2e-4 / w4 + 1e-5 / (w4 * w2) + 1e-6 / (w4 * w4) + 1e-3 * w4
           + 1e-4 * w4 * w2},
      {13, "2.2 -0.01 1e-3 0.01 2e-4 1e-5 1e-6 1e-7 1e-8",
       2.2 - 0.01 * w2 + 1e-3 * w4 + 0.01 / w2 + 2e-4 / w4 + 1e-5 / (w4 * w2) + 1e-6 / (w4 * w4)
           + 1e-7 * std::pow(w, -10) + 1e-8 * std::pow(w, -12)},
  };
  for (Case const& c : cases) {
    auto const glasses =
        read_agf("NM X " + std::to_string(c.id) + " 0 - 60 0 0 -1\nCD " + c.cd + "\nLD 0.4 0.7\n",
                 "")
            .glasses;
    ASSERT_EQ(glasses.size(), 1u) << c.id;
    EXPECT_NEAR(glasses.front()->index_unchecked(500), std::sqrt(c.n2), 1e-14) << c.id;
  }
}

/// "3 A: message", one a line; a lost glass is marked by "lost".
std::string problems(AgfCatalogue const& catalogue) {
  std::string all;
  for (auto const& p : catalogue.problems)
    all += std::to_string(p.line) + " " + p.glass + (p.lost ? " lost: " : ": ") + p.message + "\n";
  return all;
}
std::string problems(std::string const& text) {
  return problems(read_agf(text, ""));
}
std::string names(AgfCatalogue const& catalogue) {
  std::string all;
  for (auto const& glass : catalogue.glasses) all += glass->name() + " ";
  return all;
}

TEST(Agf, ProblemsNameLineAndGlass) {
  EXPECT_EQ(problems("CC x\nNM A 14 0 1.5 60\nCD 1 2 3\n"),
            "2 A lost: it uses formula 14; known are 1 to 13\n");
  EXPECT_EQ(problems("NM A 2.5 0 1.5 60\nCD 1 2 3\n"),
            "1 A lost: it uses formula 2.5; known are 1 to 13\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01x\n"), "2 A lost: '0.01x' is no number\n");
  EXPECT_EQ(problems("NM A 2 0 1.5 60\n"), "1 A lost: it has no CD line\n");
  EXPECT_EQ(problems("NM A 2 0 1.5 60\nCD 0 0 0\n"), "2 A lost: its CD line has no coefficients\n");
  EXPECT_EQ(problems("CD 1 2\n"), "1 : CD stands before the first NM\n");
  EXPECT_EQ(problems("NM A\n"), "1 A lost: NM needs a name and the number of a formula\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nLD x 2\n"),
            "3 A: LD needs the lowest and the highest wavelength in um\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nLD 2 0.3\n"),
            "3 A: 2..0.3 um is no range of wavelengths\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nLD 300 2500\n"),
            "3 A: 300..2500 um is no light: is it in nm?\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nIT 0.5 1.5 10\n"),
            "3 A: an internal transmittance must lie in 0..1, not 1.5\n");
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nIT 0.5 0.9 0\nIT 0 0.9 10\nIT 0.5\nIT 0.5 0.9\n"),
            "3 A: a thickness must be positive, not 0\n4 A: a wavelength must be positive, not 0\n"
            "6 A: IT needs a wavelength in um, a transmittance and a thickness in mm\n");
  EXPECT_NE(problems("NM A 2 0 1.5 60\nCD 1 0.25\nLD 0.4 0.7\n").find("1 A lost: the index"),
            std::string::npos);
  EXPECT_EQ(problems("NM A 2 0 - 60\nCD 1 0.01\nNM A 2 0 - 60\nCD 1.1 0.01\n"),
            "3 A: a glass of this name stands before; this one counts\n");
  EXPECT_EQ(problems(""), "");
}

TEST(Agf, OneBadLineCostsNoOtherGlassAndNoOtherLine) {
  std::string const good = "NM GOOD 2 0 - 60\nCD 1 0.01\nLD 0.3 2.5\nIT 0.4 0.9 10\n";
  std::string const bad = "NM BAD 2 0 - 60\nCD 1 0.01\nLD 0.3 2.5\nIT 0.3 -999 10\nIT 0.4 0.8 10\n";
  auto const kept = read_agf(good + bad, "");
  EXPECT_EQ(names(kept), "GOOD BAD ");
  EXPECT_EQ(problems(kept), "8 BAD: an internal transmittance must lie in 0..1, not -999\n");
  EXPECT_NEAR(std::exp(-10 * kept.glasses[1]->absorption_per_mm(300)), 0.8, 1e-12);
  auto const lost = read_agf("NM LOST 99 0 1.5 60\nCD 1 0.01\n" + good, "");
  EXPECT_EQ(names(lost), "GOOD ");
  ASSERT_EQ(lost.problems.size(), 1u);
  EXPECT_TRUE(lost.problems[0].lost);
}

TEST(Agf, FormsOfOtherProgramsAreRead) {
  // sqrt(1 + w^2/(w^2 - 0.01)) at 0.5 um
  double const n = std::sqrt(1 + 0.25 / 0.24);
  for (char const* text : {
           "NM A 2 0 - 60\nCD 1 0.01 0 0 0 0 0 0 0 0 trailing text\nLD 0.4 0.7 more\n",
           "NM A 2.000 0 -\nCD +1.0D+00 1.0E-02\nLD 0.4 0.7\n",
           "NM A 2\rCD 1 0.01\rLD 0.4 0.7\r",
           "NM A 2\r\n\r\nCD 1,0 0,01\r\n  LD 0.4 0.7",
           "\xEF\xBB\xBFNM A 2 0 1.5x -\nGC \xE9t\xE9\nCD\t1\t0.01\n\n\nLD 0.4 0.7\nZZ 1 2\n",
       }) {
    auto const catalogue = read_agf(text, "");
    ASSERT_EQ(names(catalogue), "A ") << text;
    EXPECT_EQ(problems(catalogue), "") << text;
    EXPECT_NEAR(catalogue.glasses[0]->index_unchecked(500), n, 1e-14) << text;
    EXPECT_EQ(catalogue.glasses[0]->range_nm().lo_nm, 400) << text;
  }
  EXPECT_EQ(names(read_agf("NM LIGHT CROWN 2 0 - 60\nCD 1 0.01\n", "")), "LIGHT CROWN ");
}

TEST(Agf, ControlCharactersOfNamesReachNoMessage) {
  auto const catalogue = read_agf("NM A\x1B[2JB 99 0 1.5 60\nNM C\x07 2 0 - 60\nCD 1 0.01\n", "");
  EXPECT_EQ(problems(catalogue), "1 A?[2JB lost: it uses formula 99; known are 1 to 13\n");
  EXPECT_EQ(names(catalogue), "C? ");
}

TEST(Agf, SmallTransmittancesAreWhatTheySay) {
  auto const glass = [](std::string const& rows) {
    return read_agf("NM A 2 0 - 60\nCD 1 0.01\n" + rows, "").glasses.at(0);
  };
  EXPECT_NEAR(glass("IT 0.4 1e-30 10\n")->absorption_per_mm(400), 3 * std::log(10.0), 1e-12);
  EXPECT_NEAR(glass("IT 0.4 1e-30 0.01\n")->absorption_per_mm(400), 3000 * std::log(10.0), 1e-9);
  // A printed 0 is half the last digit of catalogues, but less than what is printed beside it.
  EXPECT_NEAR(glass("IT 0.4 0 10\nIT 0.5 0.9 10\n")->absorption_per_mm(400), -std::log(0.0005) / 10,
              1e-14);
  EXPECT_NEAR(glass("IT 0.4 0 10\nIT 0.5 1e-8 10\n")->absorption_per_mm(400), -std::log(5e-9) / 10,
              1e-14);
  // A thinner sample tells more than the 0 of a thick one.
  EXPECT_NEAR(glass("IT 0.4 0 25\nIT 0.4 0.1 2\n")->absorption_per_mm(400), -std::log(0.1) / 2,
              1e-14);
}

TEST(Agf, DoubtfulGlassesAreProblemsAndStay) {
  auto const told = [](char const* text) { return problems(read_agf(text, "")); };
  EXPECT_EQ(told("NM A 2 0 1.7 60\nCD 1 0.01\nLD 0.4 0.7\n"),
            "1 A: the index of glass 'A' is 1.42472 at the d line, but its nd says 1.7: is a "
            "coefficient wrong?\n");
  EXPECT_EQ(told("NM A 5 0 - 60\nCD 0.9997\nLD 0.4 0.7\n"),
            "1 A: the index of glass 'A' is 0.9997 at 587.562 nm; no glass lies outside 1..4\n");
  EXPECT_EQ(names(read_agf("NM A 5 0 - 60\nCD 0.9997\n", "")), "A ");
}

TEST(Agf, ReadsUtf16) {
  std::string const text = sample();
  for (bool const little : {true, false})
    for (bool const marked : {true, false}) {
      std::string wide = !marked ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
      for (char const c : text) {
        if (little) wide += c;
        wide += '\0';
        if (!little) wide += c;
      }
      EXPECT_EQ(names(read_agf(wide, "TEST")), "N-BK7 N-SF10 BK7 ");
    }
}

TEST(Agf, SurvivesDamage) {
  std::string const text = sample();
  for (std::uint64_t i = 0; i < 3000; ++i) {
    RandomKey const key = RandomKey(7).child(i);
    std::string damaged = text;
    int const edits = 1 + static_cast<int>(6 * key.uniform(0));
    for (int e = 0; e < edits && !damaged.empty(); ++e) {
      std::uint64_t const d = 10 * static_cast<std::uint64_t>(e + 1);
      std::size_t const at =
          static_cast<std::size_t>(key.uniform(d) * static_cast<double>(damaged.size()));
      if (key.uniform(d + 1) < 0.5)
        damaged[at] = static_cast<char>(256 * key.uniform(d + 2));
      else
        damaged.erase(at, static_cast<std::size_t>(60 * key.uniform(d + 3)));
    }
    auto const catalogue = read_agf(damaged, "");
    EXPECT_LE(catalogue.glasses.size(), 6u);
    for (auto const& problem : catalogue.problems) {
      EXPECT_GE(problem.line, 1);
      EXPECT_FALSE(problem.message.empty());
    }
  }
}

} // namespace
} // namespace abbe::optics
