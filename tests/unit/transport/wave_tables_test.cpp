// SPDX-License-Identifier: MIT
#include "stages.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace abbe::transport::testing {
namespace {

/// Where a wavelength lies in the range: bands below it, and its share of its own.
double position_of(optics::Bands const& bands, double lambda_nm) {
  int const band = bands.index_of(lambda_nm);
  return band + (lambda_nm - bands.edge(band)) / bands.width(band);
}

/// visit(comb) for combs of every jitter and some numbers of teeth.
template <class Visit>
void each_comb(Visit&& visit) {
  for (int const teeth : {0, 1, 3, 20})
    for (Jitter const jitter :
         {Jitter::LowDiscrepancy, Jitter::Uniform, Jitter::Stratified, Jitter::BlueNoise})
      visit(optics::Comb{teeth, jitter, 1, Follow::Every});
}

TEST(WaveTables, TeethLieInTheirStrata) {
  constexpr std::size_t samples = 40;
  for (auto const& bands : {even_bands(8), uneven_bands()})
    for (double const width : {1.0, 0.5})
      each_comb([&](optics::Comb comb) {
        comb.width = width;
        Stage const stage = spectral_stage(bands, {comb}, {589.3});
        WaveTables waves(stage, samples);
        waves.start_samples(sample_keys(samples));
        int const m = comb.teeth > 0 ? comb.teeth : bands.count();
        ASSERT_EQ(waves.drawn_teeth(0), m);
        ASSERT_EQ(waves.teeth(0), m + 1);
        std::vector<double> lowest(static_cast<std::size_t>(m), 1), highest(lowest.size(), 0);
        for (int const wave : {waves.first_draw(0), waves.second_draw(0)})
          for (std::size_t sample = 0; sample < samples; ++sample)
            for (int tooth = 0; tooth < m; ++tooth) {
              double const lambda_nm = waves.lambda_nm(wave, sample, tooth);
              double const in_stratum = position_of(bands, lambda_nm) * m / bands.count() - tooth;
              EXPECT_GE(in_stratum, 0.5 - width / 2 - 1e-9);
              EXPECT_LE(in_stratum, 0.5 + width / 2 + 1e-9);
              EXPECT_EQ(waves.channels(wave, sample)[static_cast<std::size_t>(tooth)],
                        bands.index_of(lambda_nm));
              auto const t = static_cast<std::size_t>(tooth);
              lowest[t] = std::min(lowest[t], in_stratum);
              highest[t] = std::max(highest[t], in_stratum);
            }
        // All of it.
        for (std::size_t tooth = 0; tooth < lowest.size(); ++tooth)
          EXPECT_GT(highest[tooth] - lowest[tooth], 0.8 * width);
      });
}

TEST(WaveTables, TeethOfOneNumberLieAlikeAndThoseOfTheirOwnDoNot) {
  auto const offsets = [](Jitter jitter) {
    Stage const stage = spectral_stage(even_bands(8), {{0, jitter, 1, Follow::Every}});
    WaveTables waves(stage, 1);
    waves.start_samples(sample_keys(1));
    std::vector<double> out;
    for (int tooth = 0; tooth < 8; ++tooth)
      out.push_back(position_of(stage.bands(), waves.lambda_nm(0, 0, tooth)) - tooth);
    auto const [least, most] = std::minmax_element(out.begin(), out.end());
    return *most - *least;
  };
  EXPECT_LT(offsets(Jitter::LowDiscrepancy), 1e-9);
  EXPECT_LT(offsets(Jitter::Uniform), 1e-9);
  EXPECT_LT(offsets(Jitter::BlueNoise), 1e-9);
  EXPECT_GT(offsets(Jitter::Stratified), 0.2);
}

TEST(WaveTables, ATriangleKeepsItsBandWhereverItsTeethLie) {
  Stage const stage = spectral_stage(even_bands(8), {{0, Jitter::Triangular, 2, Follow::Every}});
  constexpr std::size_t samples = 100;
  WaveTables waves(stage, samples);
  waves.start_samples(sample_keys(samples));
  bool beyond = false;
  for (std::size_t sample = 0; sample < samples; ++sample)
    for (int tooth = 0; tooth < 8; ++tooth) {
      EXPECT_EQ(waves.channels(0, sample)[static_cast<std::size_t>(tooth)], tooth);
      beyond = beyond || stage.bands().index_of(waves.lambda_nm(0, sample, tooth)) != tooth;
    }
  EXPECT_TRUE(beyond);
}

TEST(WaveTables, LinesAreWhereTheyAre) {
  Stage const stage =
      spectral_stage(even_bands(4), {{2, Jitter::Uniform, 1, Follow::Every}}, {435.8, 546.1});
  WaveTables waves(stage, 1);
  waves.start_samples(sample_keys(1));
  ASSERT_EQ(waves.teeth(0), 4);
  for (int line = 0; line < 2; ++line) {
    auto const tooth = static_cast<std::size_t>(2 + line),
               channel = static_cast<std::size_t>(4 + line);
    EXPECT_EQ(waves.lambda_nm(0, 0, 2 + line),
              stage.spectral->lines_nm[static_cast<std::size_t>(line)]);
    EXPECT_EQ(waves.channels(0, 0)[tooth], channel);
    EXPECT_EQ(waves.rgb_weights(0, 0)[tooth], stage.rgb_weights[channel]);
    auto const spread = waves.spreads(0, 0)[tooth];
    EXPECT_EQ(spread.first, 4 + line);
    EXPECT_EQ(spread.first_weight, 1);
    EXPECT_EQ(spread.second_weight, 0);
  }
}

/// What each band receives of light 1 at every tooth.
std::vector<double> received(WaveTables& waves, int wave, std::size_t sample, int bands) {
  std::vector<double> out(static_cast<std::size_t>(bands));
  for (auto const& spread : waves.spreads(wave, sample)) {
    EXPECT_GE(spread.first_weight, 0);
    EXPECT_GE(spread.second_weight, 0);
    out[static_cast<std::size_t>(spread.first)] += spread.first_weight;
    out[static_cast<std::size_t>(spread.second)] += spread.second_weight;
  }
  return out;
}

TEST(WaveTables, SpreadsOfAToothABandOrMoreSumToOneInEachBand) {
  for (auto const& bands : {even_bands(8), uneven_bands()})
    each_comb([&](optics::Comb const& comb) {
      if (comb.teeth != 0 && comb.teeth < bands.count()) return;
      Stage const stage = spectral_stage(bands, {comb});
      constexpr std::size_t samples = 20;
      WaveTables waves(stage, samples);
      waves.start_samples(sample_keys(samples));
      for (std::size_t sample = 0; sample < samples; ++sample)
        for (double const sum : received(waves, 1, sample, bands.count()))
          EXPECT_NEAR(sum, 1, 1e-14);
    });
}

TEST(WaveTables, SpreadsOfFewerTeethSumToOneInTheMean) {
  constexpr std::size_t samples = 2000;
  for (auto const& bands : {even_bands(8), uneven_bands()}) {
    Stage const stage = spectral_stage(bands, {{2, Jitter::LowDiscrepancy, 1, Follow::Every}});
    WaveTables waves(stage, samples);
    waves.start_samples(sample_keys(samples));
    std::vector<double> mean(static_cast<std::size_t>(bands.count()));
    for (std::size_t sample = 0; sample < samples; ++sample) {
      auto const sums = received(waves, 0, sample, bands.count());
      for (std::size_t band = 0; band < mean.size(); ++band) mean[band] += sums[band] / samples;
    }
    for (double const value : mean) EXPECT_NEAR(value, 1, 0.01);
  }
}

TEST(WaveTables, OneToothIsSpreadOverItsTwoBandsByItsDistances) {
  // Bands 400..500..600, centres 450 and 550; a stratum of 200 nm; each hat covers 100 nm.
  Stage const stage =
      spectral_stage(even_bands(2, 400, 600), {{1, Jitter::LowDiscrepancy, 1, Follow::Every}});
  constexpr std::size_t samples = 30;
  WaveTables waves(stage, samples);
  waves.start_samples(sample_keys(samples));
  for (std::size_t sample = 0; sample < samples; ++sample) {
    double const along = std::clamp((waves.lambda_nm(0, sample, 0) - 450) / 100, 0.0, 1.0);
    auto const sums = received(waves, 0, sample, 2);
    EXPECT_NEAR(sums[0], 2 * (1 - along), 1e-12);
    EXPECT_NEAR(sums[1], 2 * along, 1e-12);
  }
}

TEST(WaveTables, IndicesAreThoseOfTheGlassAtEachWavelength) {
  Stage stage = spectral_stage(
      uneven_bands(),
      {{3, Jitter::Stratified, 1, Follow::Every}, {0, Jitter::Uniform, 1, Follow::Doubled}},
      {589.3});
  add_glass(stage);
  stage.media[0].index_d = 1;
  stage.media[0].flat_index.assign(static_cast<std::size_t>(stage.channels), 1.0);
  constexpr std::size_t samples = 3;
  WaveTables waves(stage, samples);
  waves.start_samples(sample_keys(samples));
  optics::Glass const& glass = *stage.glasses[0];
  for (int const wave : {band_means, 0, 1, 2, 3})
    for (std::size_t sample = 0; sample < samples; ++sample) {
      int const teeth = wave == band_means ? stage.channels : waves.teeth(wave % 2);
      ASSERT_EQ(waves.indices(1, wave, sample).size(), static_cast<std::size_t>(teeth));
      for (int tooth = 0; tooth < teeth; ++tooth) {
        double const lambda_nm = waves.lambda_nm(wave, sample, tooth);
        EXPECT_EQ(waves.index(1, wave, sample, tooth), glass.index_unchecked(lambda_nm));
        EXPECT_EQ(waves.index(0, wave, sample, tooth), 1);
      }
    }
  // Where no band is of a drawn wavelength, they are the means.
  EXPECT_EQ(waves.lambda_nm(band_means, 0, 1), 480);
  EXPECT_EQ(waves.lambda_nm(band_means, 0, stage.channels - 1), 589.3);
}

TEST(WaveTables, ColoursOfAllTeethAreWhiteInTheMean) {
  constexpr std::size_t samples = 1000;
  for (auto const& bands : {even_bands(8), uneven_bands()})
    each_comb([&](optics::Comb const& comb) {
      Stage const stage = spectral_stage(bands, {comb});
      WaveTables waves(stage, samples);
      waves.start_samples(sample_keys(samples));
      Vec3 mean(0);
      for (std::size_t sample = 0; sample < samples; ++sample)
        for (Vec3 const& weight : waves.rgb_weights(0, sample))
          mean += weight / static_cast<double>(samples);
      // Numbers that are not spread evenly: four standard deviations of what varies most, the red
      // of a lone tooth.
      bool const even = comb.jitter == Jitter::LowDiscrepancy || comb.jitter == Jitter::BlueNoise;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1, even ? 0.01 : 0.25) << comb.teeth;
    });
}

TEST(WaveTables, AToothsColourIsItsStratumsWidthTimesTheDensityThere) {
  Stage const stage = spectral_stage(uneven_bands(), {{10, Jitter::Uniform, 1, Follow::Every}});
  WaveTables waves(stage, 1);
  waves.start_samples(sample_keys(1));
  for (int tooth = 0; tooth < 10; ++tooth) {
    double const lambda_nm = waves.lambda_nm(0, 0, tooth);
    double const width_nm = stage.bands().width(tooth / 2) / 2; // two teeth a band
    Vec3 const expected = width_nm * stage.bands().rgb_density(lambda_nm);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(waves.rgb_weights(0, 0)[static_cast<std::size_t>(tooth)][c], expected[c], 1e-12);
  }
}

TEST(WaveTables, AHeroIsPickedEvenlyAndStepsThroughTheRange) {
  constexpr std::size_t samples = 1000;
  constexpr double golden = 0.6180339887498949;
  for (int const teeth : {0, 5}) {
    Stage const stage =
        spectral_stage(even_bands(8), {{teeth, Jitter::LowDiscrepancy, 1, Follow::Hero}});
    WaveTables waves(stage, samples);
    waves.start_samples(sample_keys(samples));
    int const m = waves.drawn_teeth(0);
    std::vector<int> picked(static_cast<std::size_t>(m));
    double first = 0;
    for (std::size_t sample = 0; sample < samples; ++sample) {
      auto const pick = waves.pick(0, sample);
      EXPECT_EQ(pick.weight, m);
      ++picked[static_cast<std::size_t>(pick.tooth)];
      double const at = position_of(stage.bands(), waves.lambda_nm(0, sample, pick.tooth)) / 8;
      if (sample == 0) first = at;
      double const steps = at - first - golden * static_cast<double>(sample);
      EXPECT_NEAR(steps, std::round(steps), 1e-8);
    }
    for (int const count : picked) EXPECT_NEAR(count, samples / static_cast<double>(m), 3);
  }
}

TEST(WaveTables, WhatTheEyeSeesIsPickedTheMoreOften) {
  constexpr std::size_t samples = 4000;
  Stage const stage =
      spectral_stage(even_bands(8), {{4, Jitter::LowDiscrepancy, 1, Follow::Importance}});
  WaveTables waves(stage, samples);
  waves.start_samples(sample_keys(samples));
  // 1 / probability of a tooth's own picks has the mean 1: what it stands for is counted once.
  double mean[4] = {};
  for (std::size_t sample = 0; sample < samples; ++sample) {
    auto const pick = waves.pick(0, sample);
    double seen[4], total = 0;
    for (int tooth = 0; tooth < 4; ++tooth) {
      Vec3 const xyz = stage.bands().xyz_density(waves.lambda_nm(0, sample, tooth));
      total += seen[tooth] = xyz.x + xyz.y + xyz.z;
    }
    EXPECT_NEAR(1 / pick.weight, 0.1 / 4 + 0.9 * seen[pick.tooth] / total, 1e-12);
    mean[pick.tooth] += pick.weight / samples;
  }
  for (double const value : mean) EXPECT_NEAR(value, 1, 0.1);
}

TEST(WaveTables, DrawsHangOnTheKeyAlone) {
  Stage const stage = spectral_stage(even_bands(8), {{0, Jitter::Stratified, 1, Follow::Doubled}});
  WaveTables alone(stage, 1), many(stage, 5);
  auto const keys = sample_keys(5);
  many.start_samples(keys);
  for (std::size_t sample = 0; sample < keys.size(); ++sample) {
    alone.start_samples({&keys[sample], 1});
    for (int const wave : {0, 1})
      for (int tooth = 0; tooth < 8; ++tooth)
        EXPECT_EQ(alone.lambda_nm(wave, 0, tooth), many.lambda_nm(wave, sample, tooth));
    EXPECT_NE(alone.lambda_nm(0, 0, 4), alone.lambda_nm(1, 0, 4));
    if (sample > 0) {
      EXPECT_NE(many.lambda_nm(0, 0, 4), many.lambda_nm(0, sample, 4));
    }
  }
}

} // namespace
} // namespace abbe::transport::testing
