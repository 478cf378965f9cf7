// SPDX-License-Identifier: MIT
#include "geometry/placement.hpp"

#include "base/few.hpp"
#include "base/shared.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace abbe::geometry {
namespace {

bool same_bits(Transform const& a, Transform const& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(Placement, GivesBackWhatItWasMadeOf) {
  Transform const thin = Transform::scaling({0.1, 3, 7e-5});
  Transform const away = Transform::translation({1.7, -0.0, 1e9});
  Transform const turned = Transform::rotation({10, 20, 30});
  for (Transform const& t :
       {Transform{}, thin, away, turned, thin.then(away), away.then(thin), away.then(away),
        thin.then(turned).then(away), thin.then(away).inverse(),
        Transform::rounded_translation({1, 2, 3}, 4), Transform::scaling(Vec3(1))}) {
    EXPECT_TRUE(same_bits(Placement(t).transform(), t));
  }
}

TEST(Placement, ScaledAndMovedIsTheTwoSteps) {
  for (Vec3 const& scale : {Vec3(3, -0.7, 1e-200), Vec3(1), Vec3(0.1)}) {
    for (Vec3 const& offset : {Vec3(0.3, 0, -1e7), Vec3(-0.0, 5, 0.1)}) {
      EXPECT_TRUE(same_bits(Transform::scaled_and_moved(scale, offset),
                            Transform::scaling(scale).then(Transform::translation(offset))));
    }
  }
}

TEST(Transform, NoneIsTheIdentityWithoutErrors) {
  EXPECT_TRUE(Transform{}.none());
  EXPECT_FALSE(Transform::translation({0, 1, 0}).none());
  EXPECT_FALSE(
      Transform::rounded_translation(Vec3(1), 1).then(Transform::translation(Vec3(-1))).none());
}

TEST(Shared, IsOneUntilItIsChanged) {
  Shared<int> const first(7);
  Shared<int> second = first;
  EXPECT_EQ(first.held(), second.held());
  *second = 8;
  EXPECT_EQ(*first, 7);
  EXPECT_EQ(*std::as_const(second), 8);
}

TEST(Shared, OfNothingReadsAsTheDefault) {
  Shared<int> const none;
  EXPECT_FALSE(none);
  EXPECT_EQ(*none, 0);
}

TEST(Few, CopiesItsItems) {
  Few<int> list;
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.begin(), list.end());
  list.push_back(1);
  Few<int> copy = list;
  copy.append(copy);
  copy[0] = 5;
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0], 1);
  EXPECT_EQ(std::vector<int>(copy.begin(), copy.end()), (std::vector<int>{5, 1}));
}

} // namespace
} // namespace abbe::geometry
