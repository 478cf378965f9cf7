// SPDX-License-Identifier: MIT
#include "still_life.hpp"

#include <gmock/gmock.h>

namespace abbe::job::testing {
namespace {

using End = Outcome::End;
using ::testing::Each;

TEST_F(Jobs, HandOnThePicture) {
  auto const wanted = directly();
  for (int const threads : {1, 3}) {
    options.render.threads = threads;
    Kept kept;
    auto const outcome = make(kept);
    EXPECT_EQ(outcome.end, End::Done);
    EXPECT_FALSE(outcome.error);
    EXPECT_EQ(kept.image.height, 29);
    EXPECT_EQ(kept.image.rgb, wanted.image.rgb);
    EXPECT_TRUE(outcome.result.image.rgb.empty());
    EXPECT_EQ(outcome.result.counts.total(), wanted.counts.total());
    EXPECT_EQ(outcome.result.missing_mean, wanted.missing_mean);
    EXPECT_EQ(kept.passes.size(), 8u) << "a row of tiles at a time";
    EXPECT_THAT(kept.passes, Each(1));
    EXPECT_EQ(kept.finished, 1);
    EXPECT_FALSE(outcome.in_passes);
    EXPECT_GT(outcome.wall_s, 0);
    EXPECT_GT(outcome.cpu_s, 0);
  }
}

TEST_F(Jobs, ReportProgress) {
  std::vector<double> shares;
  std::vector<std::uint64_t> rays;
  options.render.on_progress = [&](render::Progress const& progress) {
    shares.push_back(progress.share);
    rays.push_back(progress.rays);
  };
  Kept kept;
  auto const outcome = make(kept);
  ASSERT_EQ(shares.size(), std::size_t{tiles});
  for (std::size_t i = 0; i < shares.size(); ++i)
    EXPECT_DOUBLE_EQ(shares[i], static_cast<double>(i + 1) / tiles);
  EXPECT_TRUE(std::is_sorted(rays.begin(), rays.end()));
  EXPECT_EQ(rays.back(), outcome.result.counts.total());
}

TEST_F(Jobs, AreInterruptedWithinATile) {
  for (int const wanted : {1, 17, tiles - 1}) {
    stop_after(wanted);
    Kept kept;
    auto const outcome = make(kept);
    EXPECT_EQ(outcome.end, End::Interrupted);
    EXPECT_EQ(told, wanted) << "no tile is finished after it";
    EXPECT_EQ(kept.finished, 0);
    EXPECT_LT(kept.image.height, 29);
    EXPECT_TRUE(outcome.resumable.empty()) << "nothing was kept";
  }
  stop = true; // before it begins
  Kept kept;
  EXPECT_EQ(make(kept).end, End::Interrupted);
  EXPECT_EQ(kept.image.height, 0);
}

/// Interrupts a job again and again, a few tiles each time, until it is through.
void expect_resumed(Options& options, Outcome& outcome, Kept& kept,
                    std::function<Outcome(Sink&)> const& make) {
  options.keeping.resume = true;
  std::size_t resumed = 0, before = 0;
  options.on_resumed = [&](std::size_t tiles) { resumed = tiles; };
  int rounds = 0;
  for (; rounds < 100; ++rounds) {
    kept = {};
    outcome = make(kept);
    EXPECT_GE(resumed, before);
    before = resumed;
    if (outcome.end != End::Interrupted) break;
    EXPECT_EQ(outcome.resumable, options.keeping.path);
    EXPECT_TRUE(fs::exists(outcome.resumable));
  }
  EXPECT_GT(rounds, 2);
  EXPECT_GT(resumed, 0u);
}

TEST_F(Jobs, ResumeToTheSameBytes) {
  for (int const variant : {0, 1, 2}) {
    options.render.anti_aliasing = variant > 0 ? jittered() : render::AntiAliasing{};
    options.render.passes = variant == 2 ? 2 : 1;
    options.keeping = {};
    options.render.on_progress = nullptr;
    options.render.stop = nullptr;
    auto const wanted = directly();
    keep();
    Kept kept;
    Outcome outcome;
    // Tiles of the checkpoint are told of too: each round goes further.
    int more = 0;
    expect_resumed(options, outcome, kept, [&](Sink& sink) {
      stop_after(more += 23);
      options.render.threads = 1 + more % 2;
      return make(sink);
    });
    EXPECT_EQ(outcome.end, End::Done);
    EXPECT_EQ(kept.image.rgb, wanted.image.rgb);
    EXPECT_EQ(outcome.result.counts.total(), wanted.counts.total());
    EXPECT_EQ(outcome.result.missing_mean, wanted.missing_mean);
    EXPECT_EQ(outcome.result.missing_most, wanted.missing_most);
    EXPECT_TRUE(fs::is_empty(folder)) << "the picture is complete";
  }
}

TEST_F(Jobs, ResumeFromNothing) {
  keep();
  options.keeping.resume = true;
  std::optional<std::size_t> resumed;
  options.on_resumed = [&](std::size_t count) { resumed = count; };
  Kept kept;
  EXPECT_EQ(make(kept).end, End::Done);
  EXPECT_EQ(resumed, 0u);
}

TEST_F(Jobs, DoNotResumeAnotherPicture) {
  keep();
  stop_after(9);
  Kept kept;
  ASSERT_EQ(make(kept).end, End::Interrupted);
  options.render.stop = nullptr;
  options.keeping.resume = true;
  options.on_resumed = [](std::size_t) { ADD_FAILURE() << "nothing is resumed"; };
  auto const refused = [&](Options other, char const* code) {
    Kept rows;
    auto const outcome = run(scene::Scene(scene), *plan, other, rows);
    EXPECT_EQ(outcome.end, End::NotResumed);
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, code);
    EXPECT_EQ(rows.image.height, 0);
    EXPECT_TRUE(fs::exists(options.keeping.path)) << "it stays";
  };
  auto other = options;
  other.keeping.scene_identity = 8;
  refused(other, "E0520");
  other = options;
  other.render.seed = 1;
  refused(other, "E0520");
  fs::resize_file(options.keeping.path, 20);
  refused(options, "E0521");
}

TEST_F(Jobs, WithoutResumingBeginAgain) {
  auto const wanted = directly();
  keep();
  stop_after(9);
  Kept kept;
  ASSERT_EQ(make(kept).end, End::Interrupted);
  options.render.stop = nullptr;
  options.keeping.scene_identity = 8;
  kept = {};
  EXPECT_EQ(make(kept).end, End::Done);
  EXPECT_EQ(kept.image.rgb, wanted.image.rgb);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Jobs, ThatAreShortKeepNothing) {
  keep(Keeping::When::AfterAWhile);
  stop_after(9);
  Kept kept;
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::Interrupted);
  EXPECT_TRUE(outcome.resumable.empty());
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Jobs, GoOnWhereNothingCanBeKept) {
  keep();
  options.keeping.path = folder / "not there" / "checkpoint";
  Kept kept;
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::Done);
  EXPECT_EQ(outcome.not_kept, "No such file or directory");
  EXPECT_EQ(kept.image.rgb, render::render(scene, *plan, options.render).image.rgb);
}

TEST_F(Jobs, EndWhenRowsAreNotTaken) {
  keep();
  Kept kept;
  kept.error = Error{"E0510", "the disk is full"};
  kept.refused_call = 3;
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::NotTaken);
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->message, "the disk is full");
  EXPECT_EQ(kept.calls, 3) << "nothing more is offered";
  EXPECT_EQ(kept.finished, 0);
  EXPECT_EQ(outcome.resumable, options.keeping.path) << "what was traced is not lost";
  Kept other;
  options.keeping.resume = true;
  EXPECT_EQ(make(other).end, End::Done);
  EXPECT_EQ(other.image.rgb, render::render(scene, *plan, options.render).image.rgb);
}

TEST_F(Jobs, EndWhenThePictureIsNotFinished) {
  Kept kept;
  kept.error = Error{"E0510", "the disk is full"};
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::NotTaken);
  EXPECT_EQ(outcome.error->code, "E0510");
  EXPECT_EQ(kept.finished, 1);
}

TEST_F(Jobs, EndAtABadSample) {
  scene.background.rgb = Vec3(std::numeric_limits<double>::infinity());
  scene.settings.spectral.requested = false;
  plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  options.render.check_finite = true;
  keep();
  Kept kept;
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::BadSample);
  ASSERT_TRUE(outcome.result.bad_sample);
  EXPECT_EQ(outcome.result.bad_sample->y, 0);
  EXPECT_EQ(kept.finished, 0);
  EXPECT_TRUE(fs::is_empty(folder)) << "to go on would be of no use";
}

TEST_F(Jobs, CountTheRaysOfPixels) {
  auto const wanted = directly();
  options.count_rays = true;
  options.render.region = render::Region{3, 2, 20, 11};
  Kept kept;
  auto const outcome = make(kept);
  ASSERT_EQ(outcome.rays_of_pixels.size(), 17u * 9u);
  double sum = 0;
  for (float const rays : outcome.rays_of_pixels) sum += double(rays);
  EXPECT_EQ(sum, double(outcome.result.counts.total()));
  EXPECT_LT(outcome.result.counts.total(), wanted.counts.total());
}

TEST_F(Jobs, MakePassesUntilADeadline) {
  options.render.anti_aliasing = jittered();
  // The time is over: one pass is made, and it is a whole picture.
  options.deadline = Deadline{1e-9, Stopwatch()};
  Kept kept;
  auto const one = make(kept);
  EXPECT_EQ(one.end, End::Done);
  EXPECT_TRUE(one.in_passes);
  EXPECT_EQ(one.result.passes, 1);
  EXPECT_EQ(kept.image.rgb, directly().image.rgb);
  // Time for several.
  options.deadline = Deadline{10 * one.wall_s, Stopwatch()};
  kept = {};
  auto const several = make(kept);
  EXPECT_EQ(several.end, End::Done);
  EXPECT_EQ(kept.finished, 1);
  EXPECT_THAT(kept.passes, Each(several.result.passes));
  options.render.passes = several.result.passes;
  EXPECT_EQ(kept.image.rgb, directly().image.rgb);
}

TEST_F(Jobs, MakeOnePassWhereOthersWouldBeTheSame) {
  options.deadline = Deadline{1e6, Stopwatch()};
  Kept kept;
  auto const outcome = make(kept);
  EXPECT_EQ(outcome.end, End::Done);
  EXPECT_FALSE(outcome.in_passes);
  EXPECT_EQ(outcome.result.passes, 1);
}

} // namespace
} // namespace abbe::job::testing
