// SPDX-License-Identifier: MIT
#include "optics/bands.hpp"
#include "optics/color.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace abbe::optics {
namespace {

std::vector<Bands> all_kinds() {
  std::vector<Bands> result;
  for (int n : {1, 2, 3, 8, 16, 45, 450, 1000}) {
    result.push_back(*Bands::uniform(n));
    result.push_back(*Bands::uniform(n, 391.3, 702.77));
    result.push_back(*Bands::hall(n));
  }
  result.push_back(*Bands::from_edges({360, 400.5, 401, 500, 830}));
  return result;
}

TEST(Bands, FlatLightIsWhiteForEveryNumberOfBands) {
  for (Bands const& bands : all_kinds()) {
    std::vector<double> const flat(static_cast<std::size_t>(bands.count()), 1.0);
    Vec3 const rgb = bands.rgb(flat);
    Vec3 const xyz = bands.xyz(flat);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(rgb[c], 1, 1e-14) << bands.count();
      EXPECT_NEAR(xyz[c], srgb_white_xyz[c], 1e-14);
    }
  }
}

TEST(Bands, WeightsAreTheIntegralOfTheDensity) {
  for (Bands const& bands : all_kinds())
    for (int i = 0; i < bands.count(); ++i) {
      Vec3 const difference =
          bands.rgb_cumulative(bands.edge(i + 1)) - bands.rgb_cumulative(bands.edge(i));
      ASSERT_LT(glm::length(difference - bands.rgb_weight(i)), 1e-14);
    }
  // The density is piecewise linear: trapezoids over nanometres and the partial ends are exact.
  Bands const bands = *Bands::uniform(16, 380.25, 779.5);
  double const a = bands.edge(3), b = bands.edge(4);
  Vec3 sum(0);
  for (double x = a; x < b;) {
    double const y = std::min(std::floor(x) + 1, b);
    // The left limit at y: nodes are shared, so the density is continuous.
    sum += (bands.rgb_density(x) + bands.rgb_density(y)) * (0.5 * (y - x));
    x = y;
  }
  EXPECT_LT(glm::length(sum - bands.rgb_weight(3)), 1e-15);
}

TEST(Bands, WhiteOfTheTablesIsNearTheStandardWhite) {
  // Sums of the 1 nm products over 360-830 nm: CIE 15 gives D65 as x 0.31272, y 0.32903.
  Vec3 sum(0);
  for (int l = 360; l <= 830; ++l) sum += cie_observer(l) * d65_power_at(l);
  double const total = sum.x + sum.y + sum.z;
  EXPECT_NEAR(sum.x / total, 0.31272, 1e-5);
  EXPECT_NEAR(sum.y / total, 0.32903, 1e-5);
  EXPECT_NEAR(cie_observer(555).y, 1.0, 1e-12);
  EXPECT_NEAR(d65_power_at(560), 100, 1e-12);
}

TEST(Bands, IndexAgreesWithTheEdges) {
  for (Bands const& bands : all_kinds()) {
    for (int i = 0; i < bands.count(); ++i) {
      ASSERT_EQ(bands.index_of(bands.edge(i)), i);
      ASSERT_EQ(bands.index_of(bands.center(i)), i);
      ASSERT_EQ(bands.index_of(std::nextafter(bands.edge(i + 1), 0)), i);
    }
    EXPECT_EQ(bands.index_of(bands.hi_nm()), bands.count() - 1);
    EXPECT_EQ(bands.index_of(200), 0);
    EXPECT_EQ(bands.index_of(2000), bands.count() - 1);
  }
}

TEST(Bands, HallSpacingSharesItsDensityEqually) {
  Bands const bands = *Bands::hall(5);
  double total = 0;
  auto const sum = [](double l) {
    Vec3 const c = cie_observer(l);
    return c.x + c.y + c.z;
  };
  double const step = 0.01;
  for (double l = 380 + step / 2; l < 780; l += step) total += sum(l) * step;
  for (int i = 0; i < 5; ++i) {
    double part = 0;
    for (double l = bands.edge(i) + step / 2; l < bands.edge(i + 1); l += step)
      part += sum(l) * step;
    EXPECT_NEAR(0.7 * part / total + 0.3 * bands.width(i) / 400, 0.2,
                1e-4); // midpoint sums of 0.01 nm
  }
}

TEST(Bands, RefusesNonsense) {
  EXPECT_EQ(Bands::uniform(0).error().code, "E0416");
  EXPECT_EQ(Bands::uniform(1001).error().code, "E0416");
  EXPECT_FALSE(Bands::uniform(8, 300, 700).ok());
  EXPECT_FALSE(Bands::uniform(8, 500, 500).ok());
  EXPECT_FALSE(Bands::uniform(8, NAN, 700).ok());
  EXPECT_FALSE(Bands::hall(8, 500, 900).ok());
  EXPECT_FALSE(Bands::from_edges({400}).ok());
  EXPECT_FALSE(Bands::from_edges({400, 500, 500, 600}).ok());
  EXPECT_FALSE(Bands::from_edges({400, NAN, 600}).ok());
}

TEST(Color, MatrixIsThatOfTheStandard) {
  // IEC 61966-2-1 prints the matrix with four decimals.
  Mat3 const& m = rgb_to_xyz_matrix();
  EXPECT_NEAR(m[0][0], 0.4124, 5e-5);
  EXPECT_NEAR(m[1][1], 0.7152, 5e-5);
  EXPECT_NEAR(m[2][2], 0.9505, 5e-5);
  EXPECT_NEAR(luminance(Vec3(1)), 1, 1e-15);
}

} // namespace
} // namespace abbe::optics
