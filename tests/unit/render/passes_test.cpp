// SPDX-License-Identifier: MIT
#include "render/passes.hpp"

#include "table_scene.hpp"

#include <gtest/gtest.h>

#include <set>

namespace abbe::render::testing {
namespace {

constexpr int passes = 3;

AntiAliasing jittered(double threshold) {
  AntiAliasing aa;
  aa.method = 1;
  aa.depth = 2;
  aa.threshold = threshold;
  aa.jitter = 1;
  return aa;
}

RenderOptions small(AntiAliasing const& aa, bool spectral_output = false) {
  RenderOptions options;
  options.width = 23;
  options.height = 17;
  options.anti_aliasing = aa;
  options.spectral_output = spectral_output;
  options.seed = 5;
  return options;
}

class Passes : public ::testing::Test {
protected:
  RenderResult make(RenderOptions const& options) const { return render(scene, *plan, options); }
  void use(scene::DispersionMode mode, bool spectral = true) {
    scene = table(mode, spectral);
    plan = plan::make_plan(scene, {});
    ASSERT_TRUE(plan);
  }
  scene::Scene scene = table(stochastic(), true);
  Result<plan::Plan> plan = plan::make_plan(scene, {});
};

/// The passes made one by one, and their mean taken here.
TEST_F(Passes, AreTheMeanOfPicturesWithOtherSeeds) {
  for (auto const& aa : {AntiAliasing{}, jittered(0), jittered(0.1)}) {
    auto options = small(aa, true);
    std::vector<double> rgb, bands;
    RayCounts counts;
    for (int pass = 0; pass < passes; ++pass) {
      auto const one = make(options_of_pass(options, pass));
      rgb.resize(one.image.rgb.size());
      bands.resize(one.image.bands.size());
      for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] += double(one.image.rgb[i]);
      for (std::size_t i = 0; i < bands.size(); ++i) bands[i] += double(one.image.bands[i]);
      counts.add(one.counts);
    }
    options.passes = passes;
    auto const all = make(options);
    EXPECT_EQ(all.passes, passes);
    EXPECT_EQ(all.counts.total(), counts.total());
    ASSERT_EQ(all.image.rgb.size(), rgb.size());
    ASSERT_EQ(all.image.bands.size(), bands.size());
    ASSERT_FALSE(bands.empty());
    for (std::size_t i = 0; i < rgb.size(); ++i)
      ASSERT_EQ(all.image.rgb[i], float(rgb[i] / passes));
    for (std::size_t i = 0; i < bands.size(); ++i)
      ASSERT_EQ(all.image.bands[i], float(bands[i] / passes));
  }
}

TEST_F(Passes, AreTheSameForAnyThreadsTilesAndRows) {
  auto options = small(jittered(0.1));
  options.passes = passes;
  options.threads = 1;
  auto const one = make(options);
  options.threads = 3;
  options.tile_size = 5;
  options.rows_bytes = 1;
  image::Image rows;
  options.on_rows = [&](image::Image const& some) {
    rows.rgb.insert(rows.rgb.end(), some.rgb.begin(), some.rgb.end());
    return true;
  };
  auto const other = make(options);
  EXPECT_EQ(one.image.rgb, rows.rgb);
  EXPECT_EQ(one.counts.total(), other.counts.total());
  EXPECT_EQ(one.missing_mean, other.missing_mean);
  EXPECT_EQ(one.missing_most, other.missing_most);
}

TEST_F(Passes, OfARegionAreThatPartOfThePicture) {
  auto options = small(jittered(0));
  options.passes = passes;
  auto const whole = make(options);
  options.region = Region{4, 3, 19, 12};
  auto const part = make(options);
  ASSERT_EQ(part.image.width, 15);
  ASSERT_EQ(part.image.height, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 45; ++x)
      ASSERT_EQ(part.image.rgb[std::size_t(45 * y + x)],
                whole.image.rgb[std::size_t(3 * (23 * (y + 3) + 4) + x)]);
}

TEST_F(Passes, FirstIsThePictureOfOne) {
  auto options = small(jittered(0));
  auto const one = make(options);
  options.passes_wanted = [](int) { return 1; };
  auto const asked = make(options);
  EXPECT_EQ(asked.passes, 1);
  EXPECT_EQ(asked.image.rgb, one.image.rgb);
  EXPECT_EQ(asked.missing_mean, one.missing_mean);
}

TEST_F(Passes, GoOnWhileTheyAreWanted) {
  auto options = small(jittered(0));
  std::vector<int> done;
  options.passes_wanted = [&](int number) {
    done.push_back(number);
    return number < 3 ? 9 : 3;
  };
  auto const asked = make(options);
  EXPECT_EQ(done, (std::vector{1, 2, 3}));
  EXPECT_EQ(asked.passes, 3);
  options.passes_wanted = nullptr;
  options.passes = 3;
  EXPECT_EQ(make(options).image.rgb, asked.image.rgb);
}

/// Each sample lies anywhere in the pixel, so the error's square falls as 1 / passes: 64 times from
/// 4 to 256; 30 leaves room for chance. Were the sample in the middle half of each pass, as of the
/// first, the error would stay. Against 40 x 40 samples.
TEST_F(Passes, Converge) {
  use(none(), false);
  auto grid = jittered(0);
  grid.depth = 40;
  auto const converged = make(small(grid)).image.rgb;
  grid.depth = 1;
  auto const error = [&](int number) {
    auto options = small(grid);
    options.passes = number;
    auto const rgb = make(options).image.rgb;
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i)
      sum += double(rgb[i] - converged[i]) * double(rgb[i] - converged[i]);
    return sum;
  };
  EXPECT_LT(error(256), error(4) / 30);
}

/// A pixel is no neighbour of its own, and is not sampled again.
TEST_F(Passes, OfOnePixel) {
  auto options = small(jittered(0));
  options.width = options.height = 1;
  auto const one = make(options);
  use(none(), true);
  auto const steady = make(options);
  options.passes = passes;
  EXPECT_EQ(make(options).image.rgb, steady.image.rgb);
}

TEST_F(Passes, RaysOfPixelsAddUp) {
  std::vector<float> rays;
  auto options = small(jittered(0.1));
  options.passes = passes;
  options.rays_of_pixels = &rays;
  auto const counts = make(options).counts;
  double sum = 0;
  for (float const each : rays) sum += double(each);
  EXPECT_EQ(sum, double(counts.total()));
}

TEST_F(Passes, StopWhereTheyAre) {
  std::atomic<bool> stop = false;
  auto options = small(jittered(0));
  options.stop = &stop;
  options.on_rows = [](image::Image const&) {
    ADD_FAILURE() << "there is no picture";
    return true;
  };
  options.passes_wanted = [&](int done) {
    stop = done == 2;
    return 9;
  };
  auto const result = make(options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.passes, 2);
}

TEST_F(Passes, DifferWhereSomethingHangsOnRandomNumbers) {
  auto steady = jittered(0);
  steady.jitter = 0;
  EXPECT_TRUE(passes_differ(*plan, {}));
  use(deterministic());
  EXPECT_FALSE(passes_differ(*plan, {}));
  EXPECT_FALSE(passes_differ(*plan, steady));
  EXPECT_TRUE(passes_differ(*plan, jittered(0)));
  auto corners = jittered(0);
  corners.method = 2;
  EXPECT_FALSE(passes_differ(*plan, corners));
}

TEST(Seeds, OfPassesDiffer) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t const seed : {0, 1, 2})
    for (int pass = 0; pass < 1000; ++pass) {
      RenderOptions options;
      options.seed = seed;
      seeds.insert(options_of_pass(options, pass).seed);
    }
  EXPECT_EQ(seeds.size(), 3000u);
}

} // namespace
} // namespace abbe::render::testing
