// SPDX-License-Identifier: MIT
#include "table_scene.hpp"

#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

/// However little memory rows may take, and however they come, they are the same.
void expect_same_in_strips(AntiAliasing const& anti_aliasing, bool spectral) {
  auto const scene = table(deterministic(), true);
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  RenderOptions options;
  options.width = 37;
  options.height = 29;
  options.tile_size = 4;
  options.anti_aliasing = anti_aliasing;
  options.spectral_output = spectral;
  auto const whole = render(scene, *plan, options);
  ASSERT_EQ(whole.image.height, 29);
  std::size_t const row_of_tiles = 37 * 4 * 3 * sizeof(float);
  for (std::size_t const bytes : {std::size_t{1}, 3 * row_of_tiles}) {
    for (int const threads : {1, 3}) {
      options.rows_bytes = bytes;
      options.threads = threads;
      image::Image pieces;
      int calls = 0;
      options.on_rows = [&](image::Image const& rows) {
        ++calls;
        EXPECT_EQ(rows.width, 37);
        pieces.height += rows.height;
        pieces.rgb.insert(pieces.rgb.end(), rows.rgb.begin(), rows.rgb.end());
        pieces.bands.insert(pieces.bands.end(), rows.bands.begin(), rows.bands.end());
        return true;
      };
      auto const result = render(scene, *plan, options);
      EXPECT_EQ(calls, 8); // 29 rows are 8 rows of tiles
      EXPECT_TRUE(result.image.rgb.empty());
      EXPECT_EQ(pieces.height, 29);
      EXPECT_EQ(pieces.rgb, whole.image.rgb);
      EXPECT_EQ(pieces.bands, whole.image.bands);
      EXPECT_EQ(result.counts.total(), whole.counts.total());
      EXPECT_EQ(result.missing_mean, whole.missing_mean);
      EXPECT_EQ(result.missing_most, whole.missing_most);
      options.on_rows = nullptr;
      EXPECT_EQ(render(scene, *plan, options).image.rgb, whole.image.rgb);
    }
  }
}

TEST(Strips, OfOneSampleAPixel) {
  expect_same_in_strips({}, false);
}
TEST(Strips, OfASpectralPicture) {
  expect_same_in_strips({}, true);
}
/// Method 1 compares rows across the strips' edges.
TEST(Strips, OfAntiAliasingBothMethods) {
  for (int const method : {1, 2}) {
    AntiAliasing anti_aliasing;
    anti_aliasing.method = method;
    anti_aliasing.depth = 2;
    expect_same_in_strips(anti_aliasing, false);
  }
}

/// Method 3 looks at the pixels around one.
TEST(Strips, OfSamples) {
  expect_same_in_strips(AntiAliasing::of({1, 16, 0.05}), false);
  expect_same_in_strips(AntiAliasing::of({3, 20, 0.02}), true);
  expect_same_in_strips(AntiAliasing::of({5, 5}), false);
}

/// Leaving in the middle: nothing more is asked for.
TEST(Strips, EndWhenNobodyTakesThem) {
  auto const scene = table(none(), false);
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  RenderOptions options;
  options.width = options.height = 32;
  options.tile_size = 4;
  options.rows_bytes = 1;
  int calls = 0;
  options.on_rows = [&](image::Image const&) { return ++calls < 3; };
  render(scene, *plan, options);
  EXPECT_EQ(calls, 3);
}

} // namespace
} // namespace abbe::render::testing
