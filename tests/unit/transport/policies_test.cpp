// SPDX-License-Identifier: MIT
#include "film.hpp"
#include "transport/wavelengths/adaptive.hpp"
#include "transport/wavelengths/apart.hpp"
#include "transport/wavelengths/doubled.hpp"
#include "transport/wavelengths/picked.hpp"

#include <gtest/gtest.h>
#include <tuple>
#include <typeinfo>

namespace abbe::transport::testing {
namespace {

/// Two rays, of the first two samples, that a surface splits: a lane a channel, or a tooth of the
/// first comb; lane k goes to direction k and carries some(k).
struct Splitting {
  Splitting(std::optional<optics::Comb> of, std::vector<double> lines_nm, bool of_teeth)
      : f(stage_of(of, std::move(lines_nm))),
        paths(f.stage),
        emitter(f.stage, arena, f.waves, f.film, paths),
        adaptive(f.stage, {}, paths) {
    f.stage.adc_bailout = 0;
    emitter.start_samples(samples);
    int const lanes = of_teeth ? f.waves.teeth(0) : f.stage.channels;
    chunk.kind = {lanes, polychromatic, of_teeth ? 0 : no_comb, false, false};
    chunk.each = chunk.kind.size();
    chunk.count = 2;
    chunk.channels = arena.take<std::uint16_t>(chunk.lanes() + 8);
    light = arena.take<double>(chunk.lanes() + 8);
    ways.x = arena.take<double>(chunk.lanes());
    ways.y = arena.take<double>(chunk.lanes());
    ways.z = arena.take<double>(chunk.lanes());
    for (std::uint32_t r = 0, k = 0; r < 2; ++r) {
      chunk.sample[r] = r;
      chunk.slot[r] = of_teeth ? f.film.tooth_slot(r, 0, 0) : f.film.channel_slot(r, 0);
      chunk.tooth[r] = 0;
      chunk.level[r] = 2;
      chunk.path[r] = Paths::none;
      for (std::uint32_t c = 0; c < chunk.each; ++c, ++k) {
        chunk.channels[k] = of_teeth ? f.waves.channels(0, r)[c] : static_cast<std::uint16_t>(c);
        light[k] = some(k);
        ways.x[k] = ways.y[k] = 0;
        ways.z[k] = k;
      }
    }
  }
  static Stage stage_of(std::optional<optics::Comb> of, std::vector<double> lines_nm) {
    Stage stage = spectral_stage(even_bands(4), {}, std::move(lines_nm));
    if (of) stage.combs = {*of};
    stage.has_adaptive = true;
    return stage;
  }
  void split(WavelengthPolicy const& policy, int wave, int comb_number = no_comb) {
    policy.split({f.stage, arena, f.waves, f.film, emitter, adaptive},
                 {chunk, light, ways, wave, comb_number, 0.5});
  }
  /// The rays that are next, all of one kind.
  Rays& next() {
    Rays* out = nullptr;
    emitter.next().each([&](QueueKey const& key, Rays& rays) {
      EXPECT_EQ(out, nullptr);
      EXPECT_FALSE(key.mirrored);
      out = &rays;
    });
    EXPECT_NE(out, nullptr);
    return *out;
  }

  Film f;
  Arena arena;
  Paths paths;
  Emitter emitter;
  AdaptiveSplits adaptive;
  Chunk chunk;
  double* light = nullptr;
  SplitLanes ways;
};

TEST(SplitApart, SendsARayALaneThatHasLight) {
  Splitting s({}, {589.3}, false);
  s.f.stage.max_trace_level = 9;
  s.light[3] = 0;
  s.split(SplitApart(), band_means);
  Rays const& rays = s.next();
  EXPECT_EQ(rays.kind(), (LightKind{1, band_means, no_comb, true, false}));
  ASSERT_EQ(rays.count(), 9);
  for (std::size_t i = 0, k = 0; i < 9; ++i, ++k) {
    if (k == 3) ++k;
    EXPECT_EQ(rays.direction.get(i), Vec3(0, 0, double(k)));
    EXPECT_EQ(rays.light_of(i)[0], some(k));
    EXPECT_EQ(rays.slot[i], s.f.film.channel_slot(k < 5 ? 0 : 1, static_cast<int>(k % 5)));
    EXPECT_EQ(rays.channel[i], k % 5);
    EXPECT_EQ(rays.tooth[i], k % 5);
    EXPECT_EQ(rays.level[i], 3);
  }
  EXPECT_EQ(s.emitter.counts.monochromatic, 9);
}

TEST(SplitPicked, FollowsOneToothAtItsWeightAndEachLine) {
  for (auto const follow : {Follow::Hero, Follow::Importance}) {
    Splitting s(comb(follow, 7), {546.1, 589.3}, true);
    s.split(SplitPicked(), 0, 0);
    Rays const& rays = s.next();
    ASSERT_EQ(rays.count(), 6);
    for (std::uint32_t r = 0, i = 0; r < 2; ++r) {
      auto const pick = s.f.waves.pick(0, r);
      auto const picked = 9 * r + static_cast<std::size_t>(pick.tooth);
      EXPECT_EQ(rays.slot[i], s.f.film.picked_slot(r, 0, pick.tooth));
      EXPECT_EQ(rays.light_of(i)[0], some(picked) * pick.weight);
      EXPECT_EQ(rays.tooth[i], pick.tooth);
      EXPECT_EQ(rays.direction.get(i++), Vec3(0, 0, double(picked)));
      for (int tooth = 7; tooth < 9; ++tooth, ++i) {
        EXPECT_EQ(rays.slot[i], s.f.film.tooth_slot(r, 0, tooth));
        EXPECT_EQ(rays.light_of(i)[0], some(9 * r + static_cast<std::size_t>(tooth)));
        EXPECT_EQ(rays.channel[i], tooth - 3); // lines come behind the four bands
      }
    }
  }
}

TEST(SplitDoubled, MakesEachBandLightOfTheTwoThatItsWavelengthIsBetween) {
  Splitting s(comb(Follow::Doubled), {}, false);
  s.split(SplitDoubled(), 0, 0);
  Rays const& rays = s.next();
  EXPECT_EQ(rays.kind(), (LightKind{2, 0, 0, false, false}));
  ASSERT_EQ(rays.count(), 8);
  for (std::uint32_t r = 0, k = 0; r < 2; ++r)
    for (int band = 0; band < 4; ++band, ++k) {
      auto const& spread = s.f.waves.spreads(0, r)[static_cast<std::size_t>(band)];
      EXPECT_EQ(rays.slot[k], s.f.film.doubled_slot(r, 0, band));
      EXPECT_EQ(rays.channels[2 * k], spread.first);
      EXPECT_EQ(rays.channels[2 * k + 1], spread.second);
      EXPECT_EQ(rays.light_of(k)[0], some(k) * spread.first_weight);
      EXPECT_EQ(rays.light_of(k)[1], some(k) * spread.second_weight);
      EXPECT_EQ(rays.tooth[k], band);
    }
}

TEST(SplitAdaptively, SendsTheEndsOfBandsAndEachLineFirst) {
  Splitting s({}, {546.1}, false);
  s.split(SplitAdaptively(), band_means);
  Rays const& rays = s.next();
  ASSERT_EQ(rays.count(), 6);
  // Bands 0 and 3, and the line: it is alone, as its wavelength is not beyond the last band's.
  int const lanes[] = {0, 3, 4, 0, 3, 4};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(rays.channel[i], lanes[i]);
}

TEST(PolicyOf, IsThatOfTheMode) {
  auto const is = [](WavelengthPolicy const& policy, auto const& wanted) {
    return typeid(policy) == typeid(wanted);
  };
  EXPECT_TRUE(is(policy_of(nullptr, 0), SplitApart()));
  EXPECT_TRUE(is(policy_of(nullptr, 0.5), SplitAdaptively()));
  for (auto const& [follow, doubles, picks] :
       {std::tuple(Follow::Every, false, false), std::tuple(Follow::Doubled, true, false),
        std::tuple(Follow::Hero, false, true), std::tuple(Follow::Importance, false, true)}) {
    optics::Comb const of = comb(follow);
    WavelengthPolicy const& policy = policy_of(&of, 0);
    EXPECT_EQ(is(policy, SplitDoubled()), doubles);
    EXPECT_EQ(is(policy, SplitPicked()), picks);
    EXPECT_EQ(is(policy, SplitApart()), !doubles && !picks);
  }
}

} // namespace
} // namespace abbe::transport::testing
