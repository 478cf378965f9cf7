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
  auto const glasses = read_agf(sample(), "TEST");
  ASSERT_TRUE(glasses.ok()) << glasses.error().message;
  ASSERT_EQ(glasses->size(), 3u);
  auto const& bk7 = *glasses->at(0);
  EXPECT_EQ(bk7.full_name(), "TEST/N-BK7");
  EXPECT_EQ(bk7.status(), "preferred");
  EXPECT_NEAR(*bk7.nd(), 1.5168, 1e-5);
  EXPECT_NEAR(*bk7.vd(), 64.17, 5e-3);
  EXPECT_EQ(bk7.range_nm().lo_nm, 300);
  EXPECT_NEAR(std::exp(-25 * bk7.absorption_per_mm(400)), 0.994, 1e-12);
  EXPECT_NEAR(std::exp(-10 * bk7.absorption_per_mm(320)), 0.77, 1e-12);
  EXPECT_NEAR(*glasses->at(1)->nd(), *glasses->at(1)->printed_nd(), 1e-5);
  EXPECT_FALSE(glasses->at(1)->absorbs());
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
    auto const glasses = read_agf(
        "NM X " + std::to_string(c.id) + " 0 1.5 60 0 0 -1\nCD " + c.cd + "\nLD 0.4 0.7\n", "");
    ASSERT_TRUE(glasses.ok()) << c.id << glasses.error().message;
    EXPECT_NEAR(glasses->front()->index_unchecked(500), std::sqrt(c.n2), 1e-14) << c.id;
  }
}

TEST(Agf, MistakesNameTheirLine) {
  auto const message = [](char const* text) {
    auto const r = read_agf(text, "");
    return r.ok() ? std::string("ok") : r.error().message;
  };
  EXPECT_EQ(message("CC x\nNM A 14 0 1.5 60\nCD 1 2 3\n"),
            "line 2: glass 'A' uses formula 14; known are 1 to 13");
  EXPECT_EQ(message("NM A 2 0 1.5 60\nCD 1 0.01x\n"), "line 2: '0.01x' is no number");
  EXPECT_EQ(message("NM A 2 0 1.5 60\n"), "line 1: glass 'A' has no CD line");
  EXPECT_EQ(message("CD 1 2\n"), "line 1: CD stands before the first NM");
  EXPECT_EQ(message("NM A\n"), "line 1: NM needs a name and the number of a formula");
  EXPECT_EQ(message("NM A 2 0 1.5 60\nCD 1 0.01\nLD x 2\n"),
            "line 3: LD needs the lowest and the highest wavelength in um");
  EXPECT_EQ(message("NM A 2 0 1.5 60\nCD 1 0.01\nIT 0.5 1.5 10\n"),
            "line 3: an internal transmittance must lie in 0..1, not 1.5");
  EXPECT_NE(message("NM A 2 0 1.5 60\nCD 1 0.25\nLD 0.4 0.7\n").find("pole"), std::string::npos);
  EXPECT_EQ(message(""), "ok");
}

TEST(Agf, ReadsUtf16) {
  std::string const text = sample();
  std::string wide = "\xFF\xFE";
  for (char const c : text) {
    wide += c;
    wide += '\0';
  }
  auto const glasses = read_agf(wide, "TEST");
  ASSERT_TRUE(glasses.ok());
  EXPECT_EQ(glasses->size(), 3u);
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
    auto const glasses = read_agf(damaged, "");
    if (!glasses.ok()) {
      EXPECT_TRUE(glasses.error().message.starts_with("line ")) << glasses.error().message;
    }
  }
}

} // namespace
} // namespace abbe::optics
