// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "optics/spectra_data.hpp"
#include "optics/uplift.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

namespace abbe::optics {
namespace {

double error_of(Vec3 const& rgb, Bands const& bands, std::vector<double>* out = nullptr) {
  auto const values = uplift(rgb, bands);
  Vec3 const d = glm::abs(bands.rgb(values) - rgb);
  if (out) *out = values;
  return std::max({d.x, d.y, d.z});
}

TEST(Uplift, RoundTripsTheWholeGamutForEveryNumberOfBands) {
  for (int n : {3, 4, 8, 16, 45, 450}) {
    Bands const bands = *Bands::uniform(n);
    double worst = 0, low = 0, high = 1;
    int outside = 0;
    std::clock_t const start = std::clock();
    for (int r = 0; r <= 16; ++r)
      for (int g = 0; g <= 16; ++g)
        for (int b = 0; b <= 16; ++b) {
          std::vector<double> values;
          worst = std::max(worst, error_of(Vec3(r, g, b) / 16.0, bands, &values));
          auto const [least, most] = std::minmax_element(values.begin(), values.end());
          outside += *least < -1e-9 || *most > 1 + 1e-9;
          low = std::min(low, *least);
          high = std::max(high, *most);
        }
    double const time_us = 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(worst, 1e-9) << n;
    std::printf(
        "n %3d: worst %.1e, values %.3f..%.3f, outside [0,1]: %d of 4913, %.1f us a colour\n", n,
        worst, low, high, outside, time_us / 4913);
    // With enough bands every sRGB colour is a reflectance.
    if (n >= 16) {
      EXPECT_GT(low, -0.05) << n;
      EXPECT_LT(high, 1.05) << n;
    }
  }
}

TEST(Uplift, GreyIsExactlyFlat) {
  for (double grey : {0.0, 1e-9, 0.18, 1.0, 7.5, -0.25})
    for (int n : {1, 2, 3, 16, 450})
      for (double const v : uplift(Vec3(grey), *Bands::hall(n))) EXPECT_EQ(v, grey);
}

TEST(Uplift, TakesDarkBrightAndNegativeColours) {
  RandomKey const key(5);
  for (int n : {3, 8, 16, 45}) {
    Bands const bands = n == 8 ? *Bands::hall(n) : *Bands::uniform(n);
    for (int i = 0; i < 500; ++i) {
      RandomKey const k = key.child(static_cast<std::uint64_t>(i));
      Vec3 const rgb = (Vec3(k.uniform(0), k.uniform(1), k.uniform(2)) * 3.0 - 1.0)
                       * std::pow(10.0, 6 * k.uniform(3) - 4);
      double const size = std::max({std::abs(rgb.x), std::abs(rgb.y), std::abs(rgb.z), 1.0});
      EXPECT_LT(error_of(rgb, bands), 1e-9 * size);
    }
  }
}

TEST(Uplift, SmallChangesOfColourChangeTheSpectrumLittle) {
  Bands const bands = *Bands::uniform(16);
  auto const a = uplift(Vec3(0.6, 0.3, 0.2), bands);
  auto const b = uplift(Vec3(0.6 + 1e-6, 0.3, 0.2), bands);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5);
  // Towards grey the spectrum becomes the flat one.
  for (double const v : uplift(Vec3(0.5, 0.5, 0.5 + 1e-7), bands)) EXPECT_NEAR(v, 0.5, 1e-6);
}

TEST(Uplift, IsNearTheMeasuredReflectanceOfTheColorChecker) {
  auto const library = *DataLibrary::open(std::filesystem::path(ABBE_STDLIB_DIR) / "spectra");
  Bands const bands = *Bands::uniform(45);
  double sum = 0;
  for (int patch = 1; patch <= 24; ++patch) {
    auto const measured =
        *reflectance_bands(*load_reflectance(library, fmt::format("macbeth/{}", patch)), bands);
    auto const guess = uplift(bands.rgb(measured), bands);
    double square = 0;
    // Beyond 430..680 nm the colour says nothing about the spectrum.
    int count = 0;
    for (int i = 0; i < bands.count(); ++i)
      if (bands.center(i) > 430 && bands.center(i) < 680) {
        double const d = guess[static_cast<std::size_t>(i)] - measured[static_cast<std::size_t>(i)];
        square += d * d;
        ++count;
      }
    sum += std::sqrt(square / count);
  }
  std::printf("mean rms difference to the measured reflectance: %.4f\n", sum / 24);
  EXPECT_LT(sum / 24, 0.05);
}

TEST(Uplift, FewerThanThreeBandsKeepTheLuminance) {
  auto const values = uplift(Vec3(1, 0, 0), *Bands::uniform(2));
  EXPECT_EQ(values[0], values[1]);
  EXPECT_NEAR(values[0], 0.2126, 5e-5);
}

} // namespace
} // namespace abbe::optics
