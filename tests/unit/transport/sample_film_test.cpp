// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

namespace abbe::transport::testing {
namespace {

void expect_near(Vec3 const& a, Vec3 const& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-12);
}

std::vector<optics::Comb> all_kinds() {
  return {comb(Follow::Every), comb(Follow::Hero, 3), comb(Follow::Doubled),
          comb(Follow::Every, 0, Jitter::Triangular), comb(Follow::Importance, 20)};
}

TEST(SampleFilm, EverySlotOfEveryBlockIsOneThing) {
  Film f(spectral_stage(even_bands(4), all_kinds(), {589.3}));
  auto const first_apart = f.film.add_block(1);
  EXPECT_EQ(first_apart, samples);
  EXPECT_EQ(f.film.add_block(first_apart), first_apart + 1);
  std::set<std::uint32_t> seen;
  std::size_t asked = 0;
  for (SampleFilm::Block block = 0; block < first_apart + 2; ++block) {
    auto const take = [&](std::uint32_t slot) {
      ++asked;
      seen.insert(slot);
      EXPECT_EQ(f.film.block_of(slot), block);
      EXPECT_LT(slot - f.film.first(block), f.film.slots());
      EXPECT_EQ(f.film.sample_of(slot), block < samples ? block : 1);
    };
    for (int c = 0; c < 5; ++c) take(f.film.channel_slot(block, c));
    for (int j = 0; j < 5; ++j) {
      if (!f.film.has_control(j)) continue;
      bool const doubled = f.stage.combs[static_cast<std::size_t>(j)].follow == Follow::Doubled;
      bool const picks = f.stage.combs[static_cast<std::size_t>(j)].picks_one();
      for (int tooth = 0; tooth < f.waves.teeth(j); ++tooth) {
        if (doubled) {
          take(f.film.doubled_slot(block, j, tooth));
          take(f.film.doubled_slot(block, j, tooth) + 1);
        } else {
          take(f.film.tooth_slot(block, j, tooth));
        }
        if (picks) take(f.film.picked_slot(block, j, tooth));
      }
      for (int c = 0; c < 5; ++c) {
        take(f.film.control_slot(block, j, c));
        if (picks) take(f.film.picked_control_slot(block, j, c));
      }
    }
  }
  EXPECT_EQ(seen.size(), asked);
  EXPECT_EQ(asked, 5 * f.film.slots());
}

TEST(SampleFilm, RedGreenAndBlueAreThemselves) {
  Film f(rgb_stage());
  for (int c = 0; c < 3; ++c) f.film[f.film.channel_slot(1, c)] = c + 0.25;
  EXPECT_EQ(f.rgb(0), Vec3(0));
  EXPECT_EQ(f.rgb(1), Vec3(0.25, 1.25, 2.25));
  f.film.start_samples(2);
  EXPECT_EQ(f.rgb(1), Vec3(0));
}

TEST(SampleFilm, BandsAreTheirColoursAndLinesComeIntoTheirBands) {
  Film f(spectral_stage(even_bands(4, 400, 800), {}, {589.3}));
  Vec3 expected(0);
  for (int c = 0; c < 5; ++c) {
    double const light = f.film[f.film.channel_slot(2, c)] = some(static_cast<std::size_t>(c));
    expected += light * f.stage.rgb_weights[static_cast<std::size_t>(c)];
  }
  expect_near(f.rgb(2), expected);
  auto const bands = f.bands(2);
  for (std::size_t band = 0; band < 4; ++band) {
    double value = some(band);
    // Power of one nm, over that of the whole band.
    if (band == 1)
      value += some(4) * optics::d65_power_at(589.3) / (f.stage.bands().d65_power(1) * 100);
    EXPECT_NEAR(bands[band], value, 1e-12);
  }
}

/// The sum over channels and teeth of a comb, from its definition.
Vec3 comb_sum(Film& f, std::size_t sample, int number, Vec3 const& plain) {
  auto const block = static_cast<SampleFilm::Block>(sample);
  Vec3 sum = plain;
  for (int c = 0; c < f.stage.channels; ++c)
    sum += f.stage.rgb_weights[static_cast<std::size_t>(c)]
           * f.film[f.film.control_slot(block, number, c)];
  for (int tooth = 0; tooth < f.waves.teeth(number); ++tooth) {
    auto const t = static_cast<std::size_t>(tooth);
    int const channel = f.waves.channels(f.waves.first_draw(number), sample)[t];
    sum += f.waves.rgb_weights(f.waves.first_draw(number), sample)[t]
           * (f.film[f.film.tooth_slot(block, number, tooth)]
              - f.film[f.film.control_slot(block, number, channel)]);
  }
  return sum;
}

/// Light in all slots of a sample.
void fill(Film& f, SampleFilm::Block block) {
  for (std::uint32_t slot = 0; slot < f.film.slots(); ++slot)
    f.film[f.film.first(block) + slot] = some(slot);
}

TEST(SampleFilm, CombsAreTheirControlLightAndWhatTheTeethDifferByFromIt) {
  for (int const teeth : {0, 3, 20}) {
    Film f(spectral_stage(even_bands(8), {comb(Follow::Every, teeth)}, {589.3}));
    fill(f, 1);
    Vec3 plain(0);
    for (int c = 0; c < 9; ++c)
      plain += f.film[f.film.channel_slot(1, c)] * f.stage.rgb_weights[static_cast<std::size_t>(c)];
    expect_near(f.rgb(1), comb_sum(f, 1, 0, plain));
    EXPECT_EQ(f.rgb(0), Vec3(0));
  }
}

TEST(SampleFilm, ACombThatChangesNothingIsItsControlLight) {
  for (auto const follow : {Follow::Every, Follow::Hero, Follow::Importance, Follow::Doubled}) {
    Film f(spectral_stage(even_bands(8), {comb(follow)}, {589.3}));
    Vec3 expected(0);
    for (int c = 0; c < 9; ++c) {
      f.film[f.film.control_slot(1, 0, c)] = some(static_cast<std::size_t>(c));
      expected +=
          some(static_cast<std::size_t>(c)) * f.stage.rgb_weights[static_cast<std::size_t>(c)];
    }
    auto const control = [&](int channel) { return f.film[f.film.control_slot(1, 0, channel)]; };
    auto const spreads = f.waves.spreads(0, 1);
    for (int tooth = 0; tooth < f.waves.teeth(0); ++tooth) {
      auto const t = static_cast<std::size_t>(tooth);
      if (follow == Follow::Doubled) {
        auto const& spread = spreads[t];
        f.film[f.film.doubled_slot(1, 0, tooth)] = spread.first_weight * control(spread.first);
        f.film[f.film.doubled_slot(1, 0, tooth) + 1] =
            spread.second_weight * control(spread.second);
      } else {
        f.film[f.film.tooth_slot(1, 0, tooth)] = control(f.waves.channels(0, 1)[t]);
      }
    }
    expect_near(f.rgb(1), expected);
    auto const bands = f.bands(1);
    for (std::size_t band = 0; band < 8; ++band)
      if (f.stage.bands().index_of(589.3) != static_cast<int>(band)) {
        EXPECT_NEAR(bands[band], some(band), 1e-12);
      }
  }
}

TEST(SampleFilm, OfPicksTheDifferenceOfThePickedToothCountsAtItsWeight) {
  for (auto const follow : {Follow::Hero, Follow::Importance}) {
    Film f(spectral_stage(even_bands(8), {comb(follow, 5)}));
    fill(f, 1);
    Vec3 plain(0);
    for (int c = 0; c < 8; ++c)
      plain += (f.film[f.film.channel_slot(1, c)] + f.film[f.film.picked_control_slot(1, 0, c)])
               * f.stage.rgb_weights[static_cast<std::size_t>(c)];
    auto const pick = f.waves.pick(0, 1);
    auto const tooth = static_cast<std::size_t>(pick.tooth);
    double const control = f.film[f.film.picked_control_slot(1, 0, f.waves.channels(0, 1)[tooth])];
    // What was followed carries the weight already.
    double const change = f.film[f.film.picked_slot(1, 0, pick.tooth)] - pick.weight * control;
    expect_near(f.rgb(1), comb_sum(f, 1, 0, plain) + change * f.waves.rgb_weights(0, 1)[tooth]);
  }
}

TEST(SampleFilm, ThePublishedSchemeSpreadsItsSecondDrawOverTheChannels) {
  Film f(spectral_stage(even_bands(6), {comb(Follow::Doubled)}));
  fill(f, 1);
  std::vector<double> channels(6);
  for (int c = 0; c < 6; ++c)
    channels[static_cast<std::size_t>(c)] =
        f.film[f.film.channel_slot(1, c)] + f.film[f.film.control_slot(1, 0, c)];
  for (int band = 0; band < 6; ++band) {
    auto const& first = f.waves.spreads(0, 1)[static_cast<std::size_t>(band)];
    for (int side = 0; side < 2; ++side) {
      int const own = side == 0 ? first.first : first.second;
      double const share = side == 0 ? first.first_weight : first.second_weight;
      double const change =
          f.film[f.film.doubled_slot(1, 0, band) + static_cast<std::uint32_t>(side)]
          - share * f.film[f.film.control_slot(1, 0, own)];
      auto const& second = f.waves.spreads(1, 1)[static_cast<std::size_t>(own)];
      channels[static_cast<std::size_t>(second.first)] += second.first_weight * change;
      channels[static_cast<std::size_t>(second.second)] += second.second_weight * change;
    }
  }
  auto const bands = f.bands(1);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(bands[c], channels[c], 1e-12);
  expect_near(f.rgb(1), f.stage.bands().rgb(channels));
}

TEST(SampleFilm, CombsAddUp) {
  Film f(spectral_stage(even_bands(4), all_kinds(), {589.3}));
  fill(f, 2);
  Vec3 const together = f.rgb(2);
  auto const bands = f.bands(2);
  Vec3 sum(0);
  std::vector<double> band_sums(4);
  for (std::uint32_t slot = 0; slot < f.film.slots(); ++slot) {
    f.film.start_samples(samples);
    f.film[f.film.first(2) + slot] = some(slot);
    sum += f.rgb(2);
    auto const own = f.bands(2);
    for (std::size_t band = 0; band < 4; ++band) band_sums[band] += own[band];
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(together[c], sum[c], 1e-10);
  for (std::size_t band = 0; band < 4; ++band) EXPECT_NEAR(bands[band], band_sums[band], 1e-10);
}

TEST(SampleFilm, LightInABlockApartIsNotItsSamplesYet) {
  Film f(spectral_stage(even_bands(4), all_kinds()));
  fill(f, 1);
  Vec3 const before = f.rgb(1);
  auto const block = f.film.add_block(1);
  EXPECT_FALSE(f.film.is_sample(block));
  EXPECT_TRUE(f.film.is_sample(1));
  EXPECT_EQ(f.film.sample_of_block(block), 1);
  for (std::uint32_t slot = 0; slot < f.film.slots(); ++slot)
    EXPECT_EQ(f.film[f.film.first(block) + slot], 0);
  fill(f, block);
  EXPECT_EQ(f.rgb(1), before);
  EXPECT_EQ(f.rgb(2), Vec3(0));
  // The next samples know nothing of it.
  f.film.start_samples(samples);
  EXPECT_EQ(f.film.add_block(0), samples);
  EXPECT_EQ(f.film[f.film.first(samples)], 0);
}

TEST(SampleFilm, TheSizeOfALoneSlotsLightIsWhatItAddsWithoutSign) {
  Film f(spectral_stage(even_bands(4), all_kinds(), {589.3}));
  double const light = 0.75;
  for (std::size_t sample = 0; sample < samples; ++sample)
    for (std::uint32_t own = 0; own < f.film.slots(); ++own) {
      f.film.start_samples(samples);
      std::uint32_t const slot = f.film.first(static_cast<SampleFilm::Block>(sample)) + own;
      f.film[slot] = light;
      // Teeth that were not picked have nothing in the slots of picks, ever.
      bool never = false;
      for (int const j : {1, 4})
        never = never
                || (own >= f.film.picked_slot(0, j, 0) && own < f.film.picked_control_slot(0, j, 0)
                    && own != f.film.picked_slot(0, j, f.waves.pick(j, sample).tooth));
      if (never) continue;
      SCOPED_TRACE(own);
      expect_near(f.film.size_of(slot, &light, 1, f.waves), glm::abs(f.rgb(sample)));
    }
}

TEST(SampleFilm, TheSizeOfLightBoundsWhatItAdds) {
  Film f(spectral_stage(even_bands(4), {comb(Follow::Every, 7), comb(Follow::Doubled)}));
  auto const lanes = static_cast<std::size_t>(f.film.slots());
  for (std::uint64_t turn = 0; turn < 20; ++turn) {
    f.film.start_samples(samples);
    std::vector<double> light(lanes);
    for (std::size_t k = 0; k < lanes; ++k) {
      light[k] = RandomKey(turn).uniform(k);
      f.film[f.film.first(1) + static_cast<std::uint32_t>(k)] = light[k];
    }
    Vec3 const size = f.film.size_of(f.film.first(1), light.data(), lanes, f.waves);
    Vec3 const rgb = f.rgb(1);
    for (int c = 0; c < 3; ++c) EXPECT_GE(size[c], std::abs(rgb[c]));
  }
}

} // namespace
} // namespace abbe::transport::testing
