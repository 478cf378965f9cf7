// SPDX-License-Identifier: MIT
#include "stages.hpp"
#include "transport/captures.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::transport::testing {
namespace {

constexpr std::size_t samples = 4;

/// An emitter, and a chunk of a ray for each of its samples.
struct Work {
  explicit Work(bool has_priorities = false) {
    stage.adc_bailout = 0.25;
    stage.max_trace_level = 3;
    stage.has_priorities = has_priorities;
    waves.emplace(stage, samples);
    film.emplace(stage, *waves, samples);
    paths.emplace(stage);
    emitter.emplace(stage, arena, *waves, *film, *paths);
    film->start_samples(samples);
    emitter->count_rays();
    emitter->start_samples(samples);
    chunk.kind = {3};
    chunk.each = 3;
    chunk.count = samples;
    for (std::uint32_t r = 0; r < samples; ++r) {
      chunk.sample[r] = r;
      chunk.slot[r] = film->channel_slot(r, 0);
      chunk.level[r] = 1;
      chunk.point.set(r, {r + 0.5, 1, 2});
      chunk.point_error.set(r, {1e-9 * r, 0, 0});
      chunk.hit[r].primitive = 10 + r;
      chunk.hit[r].was_entering = r == 2;
      chunk.before[r] = 20 + r;
      chunk.after[r] = 30 + r;
      chunk.travelled[r] = 40 + r;
    }
  }
  Work(Work const&) = delete;
  Work& operator=(Work const&) = delete;

  /// A ray of the chunk each, with so much light in their green.
  Departing departing(std::vector<double> const& green) {
    Departing rays = emitter->room({3}, green.size());
    rays.counted = &RayCounts::refracted;
    rays.count = green.size();
    for (std::uint32_t i = 0; i < green.size(); ++i) {
      rays.ray[i] = i;
      rays.x[i] = rays.y[i] = 0;
      rays.z[i] = 1;
      rays.level[i] = 2;
      rays.slot[i] = chunk.slot[i];
      rays.channel[i] = rays.tooth[i] = 0;
      std::fill_n(rays.light + 3 * i, 3, 0.0);
      rays.light[3 * i + 1] = green[i];
    }
    return rays;
  }
  /// The rays that are next, if they are of one queue.
  Rays& next() {
    Rays* found = nullptr;
    emitter->next().each([&](QueueKey const& key, Rays& rays) {
      EXPECT_EQ(found, nullptr);
      found = &rays;
      queue = key;
    });
    EXPECT_NE(found, nullptr);
    return *found;
  }

  Stage stage = rgb_stage();
  Arena arena;
  std::optional<WaveTables> waves;
  std::optional<SampleFilm> film;
  std::optional<Paths> paths;
  std::optional<Emitter> emitter;
  Chunk chunk;
  QueueKey queue;
};

TEST(Emitter, WhatCarriesTooLittleIsCutAndCounted) {
  Work work;
  work.emitter->send(work.chunk, work.departing({0.2501, 0.25, 0, 1}));
  Rays const& rays = work.next();
  ASSERT_EQ(rays.count(), 2);
  EXPECT_EQ(rays.slot[0], work.chunk.slot[0]);
  EXPECT_EQ(rays.slot[1], work.chunk.slot[3]);
  EXPECT_EQ(rays.light_of(1)[1], 1);
  EXPECT_EQ(work.emitter->counts.refracted, 2);
  EXPECT_EQ(work.emitter->counts.total(), 2);
  EXPECT_EQ(work.emitter->rays_of_sample, (std::vector<std::uint32_t>{1, 0, 0, 1}));
  EXPECT_EQ(work.emitter->cut_light.paths, 1); // no light is no path
  double const lost[] = {0, 0.25, 0, 0};
  for (std::size_t sample = 0; sample < samples; ++sample)
    EXPECT_EQ(work.emitter->lost_of(sample), lost[sample]);
}

TEST(Emitter, RaysOfTheLastLevelAreCountedAndCut) {
  Work work;
  auto const rays = work.departing({1, 1});
  rays.level[1] = 3;
  work.emitter->send(work.chunk, rays);
  EXPECT_EQ(work.next().count(), 1);
  EXPECT_EQ(work.next().level[0], 2);
  EXPECT_EQ(work.emitter->counts.refracted, 2);
  EXPECT_EQ(work.emitter->lost_of(1), 1);
}

TEST(Emitter, RaysGoOnBehindTheSurfaceOrComeBackBeforeIt) {
  for (bool const mirrored : {false, true}) {
    Work work;
    auto rays = work.departing({1, 1, 1});
    rays.mirrored = mirrored;
    work.emitter->send(work.chunk, rays);
    Rays const& next = work.next();
    EXPECT_EQ(work.queue.mask, mirrored ? reflection_bit : camera_bit);
    EXPECT_EQ(work.queue.mirrored, mirrored);
    for (std::uint32_t r = 0; r < 3; ++r) {
      EXPECT_EQ(next.origin.get(r), work.chunk.point.get(r));
      EXPECT_EQ(next.origin_error.get(r), work.chunk.point_error.get(r));
      EXPECT_EQ(next.stack[r], mirrored ? 20 + r : 30 + r);
      EXPECT_EQ(next.start[r], (geometry::RayStart{10 + r, 0, geometry::RayStart::Kind::Surface,
                                                   r == 2, !mirrored}));
    }
  }
}

TEST(Emitter, RaysThatGoOnAsTheyAreNeedNoLight) {
  Work work(true);
  auto rays = work.departing({1e-9, 0.5});
  rays.counted = nullptr;
  work.emitter->send(work.chunk, rays);
  EXPECT_EQ(work.next().count(), 2);
  EXPECT_EQ(work.next().travelled[1], 41); // since the last surface that was one
  EXPECT_EQ(work.emitter->counts.total(), 0);
  // Others begin anew.
  work.emitter->send(work.chunk, work.departing({1}));
  EXPECT_EQ(work.next().travelled[2], 0);
}

TEST(Emitter, GenerationsTakeTurns) {
  Work work;
  work.emitter->send(work.chunk, work.departing({1, 1}));
  EXPECT_EQ(work.emitter->turn().count(), 2);
  EXPECT_EQ(work.emitter->next().count(), 0);
  work.emitter->send(work.chunk, work.departing({1}));
  EXPECT_EQ(work.emitter->turn().count(), 1);
}

TEST(Emitter, ASampleThatHasTakenVeryManyRaysAsksMoreOfTheNext) {
  Work work;
  work.stage.adc_bailout = 0x1p-20;
  work.stage.most_rays = 16;
  work.emitter->start_samples(samples);
  auto const take = [&](std::size_t sample, int rays) {
    for (int k = 0; k < rays; ++k) work.emitter->count_ray(sample);
  };
  take(1, 20);
  take(2, 16);
  EXPECT_EQ(work.emitter->threshold(1), 0x1p-20); // from the next generation on
  work.emitter->turn();
  EXPECT_NEAR(work.emitter->threshold(1), 0x1p-16, 1e-18); // twice for each sixteenth more
  EXPECT_EQ(work.emitter->threshold(2), 0x1p-20);
  work.emitter->send(work.chunk, work.departing({0, 0x1p-17, 0x1p-17}));
  ASSERT_EQ(work.next().count(), 1);
  EXPECT_EQ(work.next().slot[0], work.chunk.slot[2]);
  take(1, 1000);
  work.emitter->turn();
  EXPECT_EQ(work.emitter->threshold(1), 1.0 / 255); // at most
  work.emitter->start_samples(samples);
  EXPECT_EQ(work.emitter->threshold(1), 0x1p-20);
}

TEST(Emitter, LossesOfLightApartAreBySlot) {
  Work work;
  auto const first = work.film->first(work.film->add_block(2));
  double const light[] = {0.5, 0, -0.25};
  work.emitter->cut(first, light, 3);
  work.emitter->cut(first, light, 1);
  EXPECT_EQ(work.emitter->lost_at(first), 1);
  EXPECT_EQ(work.emitter->lost_at(first + 1), 0);
  EXPECT_EQ(work.emitter->lost_at(first + 2), 0.25);
  EXPECT_EQ(work.emitter->lost_at(first + 3), 0);
  EXPECT_EQ(work.emitter->lost_of(2), 0); // not yet
  EXPECT_EQ(work.emitter->cut_light.paths, 2);
}

TEST(Captures, RaiseWhatWasGatheredToAPowerTheLastMirrorFirst) {
  Work work;
  Captures captures(work.stage, *work.waves, *work.film, *work.emitter, *work.paths);
  captures.start();
  std::uint16_t const channels[] = {0, 1, 2};
  double const outer_weights[] = {0.5, 1, 2}, inner_weights[] = {0.25, 0.25, 0.25};
  auto& film = *work.film;
  std::uint32_t const slot = film.channel_slot(1, 0);
  std::uint32_t const outer = captures.add({3}, slot, channels, outer_weights, 2, Paths::none);
  std::uint32_t const inner = captures.add({3}, outer, channels, inner_weights, 0.5, Paths::none);
  EXPECT_EQ(film.sample_of(inner), 1);
  for (std::uint32_t c = 0; c < 3; ++c) {
    film[slot + c] = 0.125;
    film[outer + c] = 0.5;
    film[inner + c] = 4 * (c + 1.0);
  }
  captures.resolve();
  for (std::uint32_t c = 0; c < 3; ++c) {
    double const gathered = 0.5 + 0.25 * std::sqrt(4 * (c + 1.0));
    EXPECT_NEAR(film[slot + c], 0.125 + outer_weights[c] * gathered * gathered, 1e-14);
  }
}

TEST(Captures, BoundWhatIsMissingBehindThePower) {
  Work work;
  work.stage.brightest = 2; // of light that was cut, at most
  Captures captures(work.stage, *work.waves, *work.film, *work.emitter, *work.paths);
  std::uint16_t const channels[] = {0, 1, 2};
  double const weights[] = {0.5, 0.5, 0.5}, cut[] = {0.25, 0, 0};
  std::uint32_t const inner =
      captures.add({3}, work.film->channel_slot(1, 0), channels, weights, 2, Paths::none);
  (*work.film)[inner] = 1;
  work.emitter->cut(inner, cut, 3);
  captures.resolve();
  // 1 may be 1.5 in truth: 0.5 (1.5^2 - 1), as a share of the brightest.
  EXPECT_NEAR(work.emitter->lost_of(1), 0.5 * 1.25 / 2, 1e-12);
}

} // namespace
} // namespace abbe::transport::testing
