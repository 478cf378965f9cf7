// SPDX-License-Identifier: MIT
#include "optics/peaks.hpp"

#include "optics/spectra_data.hpp"
#include "optics/spectrum.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::optics {
namespace {

double energy_of(std::vector<Pair> const& rows) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    sum += 0.5 * (rows[i][1] + rows[i + 1][1]) * (rows[i + 1][0] - rows[i][0]);
  return sum;
}

/// A table in steps of 5 nm of what a spectrometer with a triangular slit of 5 nm sees: smooth
/// light and lines of no width.
std::vector<Pair> measured(std::vector<Pair> const& lines, double slope) {
  std::vector<Pair> rows;
  for (int nm = 380; nm <= 780; nm += 5) {
    double value = 1 + slope * (nm - 380);
    for (Pair const& line : lines)
      value += line[1] / 5 * std::max(0.0, 1 - std::abs(nm - line[0]) / 5);
    rows.push_back({double(nm), value});
  }
  return rows;
}

/// Lines come back where they were and as strong, from a table that shows them as peaks: the
/// triangular slit keeps sum and centre (the hat functions of a grid sum to 1 and to x).
TEST(Peaks, LinesComeBackFromATable) {
  std::vector<Pair> const lines{{404.66, 20}, {435.83, 80}, {546.07, 100}, {577.5, 60}};
  for (double const slope : {0.0, 0.001, -0.0008}) {
    auto const rows = measured(lines, slope);
    auto const split = split_peaks(rows, *Bands::uniform(16, 380, 780));
    ASSERT_EQ(split.lines.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_NEAR(split.lines[i][0], lines[i][0], 1e-9);
      EXPECT_NEAR(split.lines[i][1], lines[i][1], 1e-9 * lines[i][1]);
    }
    for (Pair const& row : split.smooth) EXPECT_NEAR(row[1], 1 + slope * (row[0] - 380), 1e-9);
  }
}

/// What is wider than the table's steps make a line, or than a band, or low, or weak, is no line.
TEST(Peaks, WhatIsNoLineStays) {
  std::vector<Pair> wide, low, weak;
  for (int nm = 380; nm <= 780; nm += 5) {
    wide.push_back({double(nm), std::exp(-std::pow((nm - 550) / 10.0, 2))}); // 17 nm at half height
    low.push_back({double(nm), nm == 550 ? 1.9 : 1});
    weak.push_back({double(nm), nm == 550 ? 0.4 : nm < 500 ? 0.1 : 8});
  }
  auto const coarse = *Bands::uniform(8, 380, 780);
  for (auto const& rows : {wide, low, weak}) EXPECT_TRUE(split_peaks(rows, coarse).lines.empty());
  // A line in a table of 5 nm is 5 nm wide at half height: bands of 4 nm show its shape.
  auto const rows = measured({{550, 100}}, 0);
  EXPECT_EQ(split_peaks(rows, *Bands::uniform(80, 380, 780)).lines.size(), 1u);
  EXPECT_TRUE(split_peaks(rows, *Bands::uniform(100, 380, 780)).lines.empty());
}

/// Of all lamps that abbe knows: energy and first moment of each table are kept, nothing becomes
/// negative, tubes and discharge lamps have lines, and smooth light has none.
TEST(Peaks, LampsKeepTheirEnergy) {
  auto const library = DataLibrary::open(std::filesystem::path(ABBE_STDLIB_DIR) / "spectra");
  ASSERT_TRUE(library);
  struct Lamp {
    char const* name;
    std::size_t least, most;
  };
  // Mercury's visible lines: 404.7, 435.8, 546.1, 577/579 nm (the last two are one in 5 nm).
  for (auto const& [name, least, most] :
       {Lamp{"A", 0, 0}, Lamp{"D65", 0, 0}, Lamp{"LED-B3", 0, 0}, Lamp{"Phosphor LED YAG", 0, 0},
        Lamp{"F2", 2, 5}, Lamp{"F11", 3, 10}, Lamp{"mercury", 3, 8}, Lamp{"LPS", 1, 3}}) {
    auto const lamp = load_light(*library, name);
    ASSERT_TRUE(lamp) << name;
    // Bands of half a nanometre show all there is.
    auto const table = lamp->split(*Bands::uniform(800, 380, 780)).smooth;
    for (int const n : {8, 16, 32, 45}) {
      auto const split = lamp->split(*Bands::uniform(n, 380, 780));
      double whole = energy_of(table), parts = energy_of(split.smooth);
      for (Pair const& line : split.lines) parts += line[1];
      EXPECT_NEAR(parts, whole, 1e-12 * whole) << name;
      for (Pair const& row : split.smooth) EXPECT_GE(row[1], 0) << name;
      for (std::size_t i = 0; i + 1 < split.smooth.size(); ++i)
        ASSERT_LT(split.smooth[i][0], split.smooth[i + 1][0]) << name;
      if (n > 32) continue;
      EXPECT_GE(split.lines.size(), least) << name << ' ' << n;
      EXPECT_LE(split.lines.size(), most) << name << ' ' << n;
    }
  }
}

} // namespace
} // namespace abbe::optics
