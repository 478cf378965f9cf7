// SPDX-License-Identifier: MIT
#include "job/pass_clock.hpp"

#include <gtest/gtest.h>

namespace abbe::job {
namespace {

/// The first pass begins at 1 s; each takes so long.
int wanted(int done, double each_s, double target_s) {
  return passes_wanted(done, 1, 1 + done * each_s, target_s);
}

TEST(PassClock, TakesAsManyAsFit) {
  EXPECT_EQ(wanted(1, 1, 11), 10);
  EXPECT_EQ(wanted(4, 1, 11), 10);
  EXPECT_EQ(wanted(1, 0.5, 11), 20);
}

TEST(PassClock, EndsNearestToTheTime) {
  EXPECT_EQ(wanted(1, 2, 10), 5) << "9 s are 4.5 passes: half a pass late is as good as half early";
  EXPECT_EQ(wanted(1, 2, 9.8), 4);
  EXPECT_EQ(wanted(3, 3, 12), 4) << "one more ends at 13";
}

TEST(PassClock, MakesNoMoreThanAQuarterLate) {
  // After the first, at 5 s, one more would end at 9 s.
  EXPECT_EQ(wanted(1, 4, 7), 1);
  EXPECT_EQ(wanted(1, 4, 7.3), 2);
}

TEST(PassClock, EndsWhenTheTimeIsOver) {
  EXPECT_EQ(wanted(1, 20, 10), 1);
  EXPECT_EQ(wanted(7, 2, 10), 7);
}

TEST(PassClock, KnowsNoPassesWithoutEnd) {
  EXPECT_EQ(passes_wanted(1, 0, 1e-12, 1e9), 1000001);
}

} // namespace
} // namespace abbe::job
