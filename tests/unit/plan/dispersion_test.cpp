// SPDX-License-Identifier: MIT
#include "plan/dispersion.hpp"

#include <gtest/gtest.h>

namespace abbe::plan {
namespace {

using scene::DispersionMode;
using Kind = DispersionMode::Kind;

DispersionMode mode(Kind kind, double tolerance_px = 0.5) {
  return {kind, {}, tolerance_px, {}};
}

DispersionMode governing(DispersionMode const& own, std::optional<double> merge_px,
                         std::optional<DispersionMode> const& given = {}) {
  scene::Interior interior;
  interior.dispersion = own;
  scene::Settings settings;
  settings.spectral.merge_px = merge_px;
  return effective_mode(interior, settings, given);
}

TEST(EffectiveMode, MergingGovernsWhatIsExactOrAdaptive) {
  for (Kind const kind : {Kind::Deterministic, Kind::Adaptive, Kind::Inherit}) {
    auto const merged = governing(mode(kind), 0.25);
    EXPECT_EQ(merged.kind, Kind::Adaptive);
    EXPECT_EQ(merged.tolerance_px, 0.25);
    EXPECT_EQ(governing(mode(kind), 0.0).kind, Kind::Deterministic);
  }
}
TEST(EffectiveMode, NotGivenEachMaterialMergesAsItSays) {
  EXPECT_EQ(governing(mode(Kind::Deterministic), {}).kind, Kind::Deterministic);
  auto const own = governing(mode(Kind::Adaptive, 2), {});
  EXPECT_EQ(own.kind, Kind::Adaptive);
  EXPECT_EQ(own.tolerance_px, 2);
}
TEST(EffectiveMode, MergingLeavesOtherModesAndTheCommandLineAlone) {
  EXPECT_EQ(governing(mode(Kind::None), 0.25).kind, Kind::None);
  EXPECT_EQ(governing(mode(Kind::Stochastic), 0.25).kind, Kind::Stochastic);
  EXPECT_EQ(governing(mode(Kind::None), 0.25, mode(Kind::Deterministic)).kind, Kind::Deterministic);
  EXPECT_EQ(governing(mode(Kind::None), 0.0, mode(Kind::Adaptive, 3)).tolerance_px, 3);
}

} // namespace
} // namespace abbe::plan
