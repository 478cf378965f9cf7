// SPDX-License-Identifier: MIT
#include "stages.hpp"
#include "transport/media_stacks.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace abbe::transport::testing {
namespace {

using geometry::SolidId, geometry::SurfaceCrossing;
using Id = MediaStacks::Id;

/// Solids 0..7: of media 1..6 with priorities 0 0 1 1 -1 5; one without a medium; one whose
/// medium is that of the first.
Stage solids() {
  Stage stage = rgb_stage();
  int const priorities[] = {0, 0, 1, 1, -1, 5};
  for (int k = 0; k < 6; ++k) {
    CompiledSolid solid;
    solid.medium = k + 1;
    solid.has_medium = true;
    solid.priority = priorities[k];
    stage.solids.push_back(solid);
  }
  stage.solids.emplace_back();
  stage.solids.push_back(stage.solids[0]);
  return stage;
}

std::vector<SolidId> list(MediaStacks const& stacks, Id stack) {
  std::vector<SolidId> out;
  stacks.each_solid(stack, [&](SolidId solid) { out.push_back(solid); });
  return out;
}

geometry::RayHit hit(SolidId solid, bool entering, bool toggles, std::uint32_t primitive = 0) {
  return {geometry::RayHit::Kind::Single, entering, toggles, entering, solid, primitive, 0};
}
SurfaceCrossing crossing(SolidId solid, bool entering, bool toggles = true) {
  return {solid, 0, 0, 1, entering, toggles};
}

TEST(MediaStacks, AnyOrderOfEnteringAndLeavingIsThatOfAList) {
  Stage const stage = solids();
  MediaStacks stacks(stage);
  std::map<std::vector<SolidId>, Id> numbers{{{}, MediaStacks::none}};
  RandomKey const random(1);
  Id stack = MediaStacks::none;
  std::vector<SolidId> inside; // the last entered first
  for (std::uint64_t step = 0; step < 5000; ++step) {
    auto const solid = static_cast<SolidId>(random.uniform(2 * step) * 6);
    bool const entering = random.uniform(2 * step + 1) < 0.45 && inside.size() < 6;
    if (entering)
      inside.insert(inside.begin(), solid);
    else if (auto const at = std::find(inside.begin(), inside.end(), solid); at != inside.end())
      inside.erase(at); // the last entered of this solid; if there is none, nothing is left
    stack = stacks.after(stack, hit(solid, entering, true));
    ASSERT_EQ(list(stacks, stack), inside);
    // Equal lists have one number.
    ASSERT_EQ(numbers.try_emplace(inside, stack).first->second, stack);
    if (inside.empty()) {
      ASSERT_EQ(stack, MediaStacks::none);
      ASSERT_EQ(stacks.medium(stack), 0);
      continue;
    }
    // The highest priority counts, and of those the last entered: the first of the list.
    auto const rules = std::max_element(inside.begin(), inside.end(), [&](auto a, auto b) {
      return stage.solids[a].priority < stage.solids[b].priority;
    });
    ASSERT_EQ(stacks.medium(stack), stage.solids[*rules].medium);
    ASSERT_EQ(stacks.priority(stack), stage.solids[*rules].priority);
  }
  EXPECT_GT(numbers.size(), 500);
}

TEST(MediaStacks, WhatHasNoMediumOrDoesNotToggleChangesNothing) {
  Stage const stage = solids();
  MediaStacks stacks(stage);
  Id const in = stacks.entered(MediaStacks::none, 2);
  EXPECT_EQ(stacks.after(in, hit(6, true, true)), in);
  EXPECT_EQ(stacks.after(in, hit(1, true, false)), in);
  EXPECT_EQ(stacks.after(in, hit(2, false, false)), in);
  SurfaceCrossing const both[] = {crossing(6, true), crossing(1, true, false)};
  EXPECT_EQ(stacks.after(in, both), in);
}

TEST(MediaStacks, OfSurfacesThatCoincideThoseThatAreLeftGoFirst) {
  Stage const stage = solids();
  MediaStacks stacks(stage);
  Id const in = stacks.entered(stacks.entered(MediaStacks::none, 0), 1);
  // Out of 1 and into 4 and 3, in whichever order they are listed.
  SurfaceCrossing const crossings[] = {crossing(4, true), crossing(1, false), crossing(3, true)};
  EXPECT_EQ(list(stacks, stacks.after(in, crossings)), (std::vector<SolidId>{3, 4, 0}));
  // Out of and into the same one.
  SurfaceCrossing const again[] = {crossing(1, true), crossing(1, false)};
  EXPECT_EQ(stacks.after(in, again), in);
  EXPECT_EQ(list(stacks, stacks.after(MediaStacks::none, again)), (std::vector<SolidId>{1}));
}

TEST(MediaStacks, OpenSolidsAreEnteredFromOutsideAndLeftFromInside) {
  Stage stage = solids();
  stage.solids[0].open = stage.solids[1].open = stage.solids[7].open = true;
  MediaStacks stacks(stage);
  for (bool const entering : {false, true}) // whichever way a normal points
    for (bool const toggles : {false, true}) {
      Id const in = stacks.after(MediaStacks::none, hit(0, entering, toggles));
      EXPECT_EQ(list(stacks, in), (std::vector<SolidId>{0}));
      EXPECT_EQ(stacks.after(in, hit(0, entering, toggles)), MediaStacks::none);
      // Another of the same medium ends it, one of another does not.
      EXPECT_EQ(stacks.after(in, hit(7, entering, toggles)), MediaStacks::none);
      EXPECT_EQ(list(stacks, stacks.after(in, hit(1, entering, toggles))),
                (std::vector<SolidId>{1, 0}));
    }
}

TEST(MediaStacks, OpenSurfacesOfOneMediumThatCoincideAreOne) {
  Stage stage = solids();
  stage.solids[0].open = stage.solids[1].open = stage.solids[7].open = true;
  MediaStacks stacks(stage);
  SurfaceCrossing const crossings[] = {crossing(0, true), crossing(7, true), crossing(1, true)};
  Id const in = stacks.after(MediaStacks::none, crossings);
  EXPECT_EQ(list(stacks, in), (std::vector<SolidId>{1, 0}));
  EXPECT_EQ(stacks.after(in, crossings), MediaStacks::none);
}

TEST(MediaStacks, NumbersStayWhateverIsForgotten) {
  // More pairs than the memory of the latest holds.
  Stage stage = solids();
  for (int k = 8; k < 2000; ++k) stage.solids.push_back(stage.solids[0]);
  MediaStacks stacks(stage);
  std::vector<Id> in;
  for (SolidId solid = 8; solid < 2000; ++solid)
    in.push_back(stacks.entered(MediaStacks::none, solid));
  for (SolidId solid = 8; solid < 2000; ++solid) {
    EXPECT_EQ(stacks.entered(MediaStacks::none, solid), in[solid - 8]);
    EXPECT_EQ(stacks.without(in[solid - 8], solid), MediaStacks::none);
  }
}

/// Solids 0 and 1 with a plain interior each; 2, whose primitives 0, 1, 2 have the interiors 0, 1
/// and none, and 3, all of interior 0; 4, of a glass; 5, without an interior that was written.
Stage plain_solids() {
  Stage stage = solids();
  for (int k : {0, 1, 2, 3, 5}) stage.solids[k].plain = true;
  for (auto& solid : stage.solids) solid.priority = 0;
  stage.interiors = {{3, false}, {4, false}};
  stage.primitive_interiors = {0, 1, -1};
  stage.solids[2].by_primitive = true;
  stage.solids[3].interior = 0;
  stage.solids[3].open = true;
  stage.solids[5].medium = 0;
  return stage;
}

TEST(MediaStacks, SharedInteriorsAreTurnedByAnyOfTheirSurfaces) {
  Stage const stage = plain_solids();
  MediaStacks stacks(stage);
  for (bool const entering : {false, true}) {
    Id const first = stacks.after(MediaStacks::none, hit(2, entering, true, 0));
    EXPECT_EQ(stacks.medium(first), 3);
    Id const both = stacks.after(first, hit(2, entering, true, 1));
    EXPECT_EQ(stacks.medium(both), 4);
    EXPECT_EQ(stacks.after(both, hit(2, entering, true, 2)), both); // it has none
    // The other solid ends the first one: what was entered later stays and counts.
    Id const second = stacks.after(both, hit(3, entering, true, 7));
    EXPECT_EQ(stacks.medium(second), 4);
    EXPECT_EQ(stacks.left(both, second), 3);
    EXPECT_EQ(stacks.after(second, hit(2, entering, true, 1)), MediaStacks::none);
  }
}

TEST(MediaStacks, SharedSurfacesThatCoincideTurnOnceOrNotAtAll) {
  Stage const stage = plain_solids();
  MediaStacks stacks(stage);
  SurfaceCrossing const twice[] = {crossing(2, true), crossing(3, true)};
  Id const in = stacks.after(MediaStacks::none, twice);
  EXPECT_EQ(stacks.medium(in), 3);
  EXPECT_EQ(stacks.after(in, twice), MediaStacks::none);
  SurfaceCrossing const through[] = {crossing(2, false), crossing(3, true)};
  EXPECT_EQ(stacks.after(in, through), in);
}

TEST(MediaStacks, ClosedSolidsThatShareAnInteriorAreOne) {
  Stage stage = plain_solids();
  stage.solids[3].open = false;
  stage.solids[5].interior = 0;
  MediaStacks stacks(stage);
  Id const in = stacks.after(MediaStacks::none, hit(3, true, true));
  Id const both = stacks.after(in, hit(5, true, true));
  EXPECT_EQ(stacks.medium(both), 3);
  EXPECT_EQ(stacks.after(both, hit(3, false, true)), in);
  EXPECT_EQ(stacks.after(in, hit(5, false, true)), MediaStacks::none);
  // Each part of the way takes its share.
  EXPECT_EQ(stacks.left(in, both), 3);
  EXPECT_EQ(stacks.left(both, in), 3);
  EXPECT_EQ(stacks.left(in, MediaStacks::none), 3);
}

TEST(MediaStacks, PlainInteriorsFadeWhereTheyEnd) {
  Stage const stage = plain_solids();
  MediaStacks stacks(stage);
  Id const one = stacks.after(MediaStacks::none, hit(0, true, true));
  Id const two = stacks.after(one, hit(1, true, true));
  EXPECT_EQ(stacks.left(MediaStacks::none, one), 0);
  EXPECT_EQ(stacks.left(one, two), 0); // not where the next begins
  EXPECT_EQ(stacks.left(two, stacks.after(two, hit(0, false, true))), 1);
  EXPECT_EQ(stacks.left(two, one), 2);
  // A glass where it no longer counts.
  Id const glass = stacks.after(MediaStacks::none, hit(4, true, true));
  EXPECT_EQ(stacks.left(glass, stacks.after(glass, hit(0, true, true))), 5);
}

TEST(MediaStacks, WithoutAnInteriorIsOfTheAirInPlainOnesAndNothingInGlass) {
  Stage const stage = plain_solids();
  MediaStacks stacks(stage);
  Id const one = stacks.after(MediaStacks::none, hit(0, true, true));
  Id const bubble = stacks.after(one, hit(5, true, true));
  EXPECT_EQ(stacks.medium(bubble), 0);
  EXPECT_EQ(stacks.left(bubble, one), 0);
  EXPECT_EQ(stacks.left(one, bubble), 0);
  EXPECT_EQ(stacks.after(bubble, hit(5, false, true)), one);
  Id const glass = stacks.after(MediaStacks::none, hit(4, true, true));
  EXPECT_EQ(stacks.after(glass, hit(5, true, true)), glass);
}

/// What keeps fog out is kept in mind, and is no medium.
TEST(MediaStacks, WhatShutsOutTheAirChangesNoMedium) {
  Stage stage = solids();
  stage.solids[6].shuts_out_air = true;
  stage.solids[1].shuts_out_air = true;
  MediaStacks stacks(stage);
  Id const shut = stacks.after(MediaStacks::none, hit(6, true, true));
  EXPECT_NE(shut, MediaStacks::none);
  EXPECT_TRUE(stacks.in_air(MediaStacks::none));
  EXPECT_FALSE(stacks.in_air(shut));
  EXPECT_EQ(stacks.medium(shut), 0);
  // In a hollow medium, in either order.
  Id const hollow = stacks.after(MediaStacks::none, hit(0, true, true));
  Id const both = stacks.after(hollow, hit(6, true, true)),
           turned = stacks.after(shut, hit(0, true, true));
  EXPECT_TRUE(stacks.in_air(hollow));
  for (Id const stack : {both, turned}) {
    EXPECT_FALSE(stacks.in_air(stack));
    EXPECT_EQ(stacks.medium(stack), 1);
    EXPECT_EQ(stacks.left(hollow, stack), 0);
    EXPECT_EQ(stacks.left(stack, hollow), 0);
    EXPECT_EQ(stacks.left(stack, shut), 1);
  }
  EXPECT_EQ(stacks.after(both, hit(6, false, true)), hollow);
  EXPECT_EQ(stacks.after(turned, hit(0, false, true)), shut);
  EXPECT_FALSE(stacks.in_air(stacks.after(MediaStacks::none, hit(1, true, true))));
}

} // namespace
} // namespace abbe::transport::testing
