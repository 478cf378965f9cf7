// SPDX-License-Identifier: MIT
#include "render/shown_error.hpp"
#include "table_scene.hpp"
#include "wedge.hpp"

#include <cmath>
#include <gtest/gtest.h>

/// Method 3: samples that are evenly apart, more where the pixel is not known well enough.
namespace abbe::render::testing {
namespace {

RenderOptions by_samples(int least, int most, double error = 0.02) {
  RenderOptions options;
  options.width = options.height = 4;
  options.anti_aliasing = AntiAliasing::of({least, most, error});
  return options;
}

/// White left of an edge, black right of it, the edge at a slant: `share` of each pixel of the
/// middle columns, on the mean of the rows.
scene::Scene wall_up_to(double edge) {
  scene::Scene scene;
  scene.camera.kind = scene::Camera::Kind::Orthographic;
  scene.camera.right = {4, 0, 0};
  scene.camera.up = {0, 4, 0};
  auto layers = plain(Vec3(1));
  layers[0].finish->ambient.rgb = Vec3(1);
  layers[0].finish->diffuse = 0;
  auto const wall = geometry::make_box({-50, -50, 2}, {edge - 2, 50, 3});
  scene.objects.push_back(object(wall->shape, wall->placement, layers));
  scene.settings.assumed_gamma = 1;
  return scene;
}

double green(image::Image const& picture, int x, int y) {
  return static_cast<double>(picture.rgb[static_cast<std::size_t>(3 * (4 * y + x) + 1)]);
}

TEST(Samples, OfAPixelAreAsManyAsAsked) {
  auto const scene = wall_up_to(1.4);
  for (int const n : {1, 2, 7, 64})
    EXPECT_EQ(render(scene, *plan::make_plan(scene), by_samples(n, n)).counts.camera,
              static_cast<std::uint64_t>(16 * n));
}

TEST(Samples, AreStratifiedAcrossThePixel) {
  // One of each of n equal columns: the share of the pixel that is covered, to 1 / n.
  for (double const share : {0.03, 0.4, 0.71})
    for (int const n : {2, 16, 256}) {
      auto const picture = testing::picture(wall_up_to(1 + share), by_samples(n, n));
      for (int y = 0; y < 4; ++y) {
        EXPECT_NEAR(green(picture, 1, y), share, 1.0 / n);
        EXPECT_EQ(green(picture, 0, y), 1);
        EXPECT_EQ(green(picture, 2, y), 0);
      }
    }
}

TEST(Samples, AreWithoutBias) {
  auto const scene = wall_up_to(1.3);
  auto const plan = plan::make_plan(scene);
  for (auto const& [least, most] : {std::pair(1, 1), std::pair(3, 3), std::pair(16, 16)}) {
    double sum = 0, squares = 0;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      auto options = by_samples(least, most);
      options.seed = seed;
      auto const picture = render(scene, *plan, options).image;
      double const mean = (green(picture, 1, 0) + green(picture, 1, 1) + green(picture, 1, 2)
                           + green(picture, 1, 3))
                          / 4;
      sum += mean;
      squares += mean * mean;
      ++count;
    }
    double const mean = sum / count;
    double const error = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_LT(std::abs(mean - 0.3), 4 * error + 1e-9) << least;
    EXPECT_LT(error, 0.03 / std::sqrt(least));
  }
}

/// Where a pixel and those around it are even, nothing more is asked; at an edge as much as the
/// error wants.
TEST(Samples, GoOnWhereThePixelIsNotKnown) {
  auto const scene = wall_up_to(1.37);
  auto const plan = plan::make_plan(scene);
  std::vector<float> rays;
  auto options = by_samples(2, 4096, 0.05);
  options.rays_of_pixels = &rays;
  auto const result = render(scene, *plan, options);
  for (std::size_t y = 0; y < 4; ++y) {
    EXPECT_EQ(rays[4 * y + 3], 2); // no edge in it or beside it
    EXPECT_GE(rays[4 * y + 1], 32);
    EXPECT_LT(rays[4 * y + 1], 4096);
    EXPECT_NEAR(green(result.image, 1, static_cast<int>(y)), 0.37, 0.02);
  }
  // A smaller error takes more, up to the most.
  options.anti_aliasing.samples.error = 0;
  EXPECT_GT(render(scene, *plan, options).counts.camera, result.counts.camera);
  EXPECT_EQ(rays[1], 4096);
}

/// A sliver that no first sample meets is looked for where the neighbour is different.
TEST(Samples, FindWhatCoversLittleOfAPixel) {
  auto const picture = testing::picture(wall_up_to(2.02), by_samples(1, 1024, 0.05));
  for (int y = 0; y < 4; ++y) EXPECT_NEAR(green(picture, 2, y), 0.02, 0.015);
}

TEST(Samples, ThreadsTilesAndStripsDoNotMatter) {
  auto const scene = wedge(n_sf11(), stochastic(), 8);
  auto options = small();
  options.anti_aliasing = AntiAliasing::of({1, 32, 0.05});
  options.threads = 1;
  options.spectral_output = true;
  auto const one = picture(scene, options);
  for (int const threads : {2, 7})
    for (int const tile : {1, 5, 64}) {
      options.threads = threads;
      options.tile_size = tile;
      options.rows_bytes = tile == 5 ? 1 : 1 << 20;
      auto const other = picture(scene, options);
      EXPECT_EQ(one.rgb, other.rgb) << threads << " threads, tiles of " << tile;
      EXPECT_EQ(one.bands, other.bands);
    }
}

/// In wavelengths and in the bands of spectral output: the mean over seeds is the picture of many
/// bands.
TEST(Samples, OfWavelengthsAreWithoutBias) {
  auto options = small();
  options.anti_aliasing = AntiAliasing::of({16, 16});
  auto const fine = picture(wedge(n_sf11(), deterministic(), 450), options);
  options.anti_aliasing = AntiAliasing::of({4, 4});
  optics::Comb comb;
  comb.teeth = 1;
  auto const scene = wedge(n_sf11(), stochastic(comb), 8);
  std::vector<double> sum(fine.rgb.size()), squares(fine.rgb.size());
  constexpr int seeds = 128;
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed) + 1;
    auto const one = picture(scene, options);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += static_cast<double>(one.rgb[i]) / seeds;
      squares[i] += std::pow(static_cast<double>(one.rgb[i]), 2) / seeds;
    }
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double bias = 0, variance = 0;
    int noisy = 0;
    for (std::size_t i = channel; i < sum.size(); i += 3) {
      bias += sum[i] - static_cast<double>(fine.rgb[i]);
      double const own = (squares[i] - sum[i] * sum[i]) / seeds;
      variance += own;
      noisy += own > 1e-8;
    }
    EXPECT_GT(noisy, 40);
    EXPECT_LT(std::abs(bias), 3 * std::sqrt(variance)) << channel;
  }
}

TEST(Samples, BandsAreTheMeanOfFirstAndFurtherOnes) {
  auto const scene = wedge(n_sf11(), deterministic(), 8);
  auto options = small();
  options.spectral_output = true;
  options.anti_aliasing = AntiAliasing::of({64, 64});
  auto const at_once = picture(scene, options);
  options.anti_aliasing = AntiAliasing::of({4, 64, 0}); // all that may be, in steps
  auto const in_steps = picture(scene, options);
  int edges = 0;
  for (std::size_t i = 0; i < at_once.rgb.size(); ++i) {
    // Pixels that are even stop at once, and have the same light.
    EXPECT_NEAR(at_once.rgb[i], in_steps.rgb[i], 2e-2);
    edges += std::abs(at_once.rgb[i] - in_steps.rgb[i]) < 1e-6F;
  }
  EXPECT_GT(edges, static_cast<int>(at_once.rgb.size() / 2));
  for (std::size_t i = 0; i < at_once.bands.size(); ++i)
    EXPECT_NEAR(at_once.bands[i], in_steps.bands[i], 0.05F * std::abs(at_once.bands[i]) + 1e-3F);
}

TEST(ShownError, IsHalfOfWhatAnErrorUpAndDownDifferBy) {
  scene::Settings settings;
  settings.assumed_gamma = 1;
  settings.version = 3.7;
  plan::WorkingSpace const linear(settings);
  // sRGB codes of 0.25 and 0.35 (IEC 61966-2-1), one channel of three.
  double const half = 0.5 * (0.626210 - 0.537099);
  EXPECT_NEAR(shown_error(Vec3(0.3), {0, 0.05, 0}, linear), half / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(shown_error(Vec3(3), Vec3(1), linear), 0); // white is white
  EXPECT_EQ(shown_error(Vec3(0.5), Vec3(0), linear), 0);
  settings.assumed_gamma_srgb = true;
  EXPECT_NEAR(shown_error(Vec3(0.3), Vec3(0.05), plan::WorkingSpace(settings)), 0.05, 1e-15);
}

TEST(ShownError, OfWhatIsMissedFallsWithTheSamples) {
  // Evenly distributed up to 1 / n, with probability 1 / n: root of 1 / (3 n^3).
  EXPECT_NEAR(missed(Vec3(0.6), 4).x, 0.6 / std::sqrt(3 * 64.0), 1e-15);
  Samples const samples{1, 64, 0.1};
  EXPECT_NEAR(tolerance(samples, 256), 0.05, 1e-15);
  EXPECT_EQ(tolerance(samples, 1e6), 0.1);
}

} // namespace
} // namespace abbe::render::testing
