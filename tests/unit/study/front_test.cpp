// SPDX-License-Identifier: MIT
#include "study/front.hpp"

#include <gtest/gtest.h>

namespace abbe::study {
namespace {

TEST(ParetoFront, HoldsWhatNothingBeats) {
  std::vector<Point> const points{{1, 10}, {2, 5}, {3, 7}, {4, 1}, {4, 2}, {5, 1}};
  EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, true, false, true, false, false}));
}

TEST(ParetoFront, EqualPointsDoNotBeatEachOther) {
  std::vector<Point> const points{{1, 1}, {1, 1}};
  EXPECT_EQ(pareto_front(points), (std::vector<bool>{true, true}));
}

TEST(CostAtError, IsAStraightLineBetweenLogarithms) {
  // Error falls as 1/cost: the error of 2 lies at the cost of 5, exactly.
  std::vector<Point> const points{{100, 0.1}, {1, 10}};
  EXPECT_NEAR(*cost_at_error(points, 2), 5, 1e-12);
}

TEST(CostAtError, OfAnErrorThatIsNeverReachedIsNothing) {
  std::vector<Point> const points{{1, 10}, {10, 3}};
  EXPECT_FALSE(cost_at_error(points, 2));
}

TEST(CostAtError, OfAnErrorThatAllReachIsTheCheapest) {
  std::vector<Point> const points{{7, 0.1}, {3, 0.2}};
  EXPECT_EQ(cost_at_error(points, 1), 3);
}

TEST(CostAtError, ToleratesAnExactSetting) {
  std::vector<Point> const points{{1, 4}, {3, 0}};
  EXPECT_EQ(cost_at_error(points, 1), 3);
}

} // namespace
} // namespace abbe::study
