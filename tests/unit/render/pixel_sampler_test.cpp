// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"

#include "geometry/shapes/box.hpp"
#include "scenes.hpp"
#include "wedge.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

/// Which samples a pixel is made of: an orthographic camera looks at the edge of a wall, so that
/// the share of samples on it is a pixel's value.
namespace abbe::render::testing {
namespace {

/// White where x is below `edge` pixels, black elsewhere, in a picture of 4 x 4.
scene::Scene edge_at(double edge) {
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

/// A sampler of a scene, with all that it needs.
struct Sampling {
  Sampling(scene::Scene const& scene, AntiAliasing const& anti_aliasing, bool check = false)
      : stage(compile(scene, *plan::make_plan(scene))) {
    options.width = options.height = 4;
    options.anti_aliasing = anti_aliasing;
    options.check_finite = check;
    options.rays_of_pixels = &rays;
    rays.resize(16);
    tracer.emplace(stage, stage.camera->footprint(4, 4));
    tracer->count_rays();
    sampler.emplace(stage, options, *tracer);
  }
  Sampling(Sampling const&) = delete;
  Sampling& operator=(Sampling const&) = delete;

  using Work = void (PixelSampler::*)(std::span<Pixel const>, Sampled*);
  std::vector<double> green(Work work, std::vector<Pixel> const& pixels) {
    std::vector<Sampled> out(pixels.size());
    ((*sampler).*work)(pixels, out.data());
    return green_of(out);
  }
  std::vector<double> refined(std::vector<Pixel> const& pixels, bool middle = false) {
    std::vector<Sampled> out(pixels.size());
    sampler->refined(pixels, middle, out.data());
    return green_of(out);
  }
  static std::vector<double> green_of(std::vector<Sampled> const& sampled) {
    std::vector<double> values;
    for (auto const& own : sampled) values.push_back(own.rgb.y);
    return values;
  }
  std::uint64_t taken() const { return tracer->counts().camera; }

  Stage stage;
  RenderOptions options;
  std::vector<float> rays;
  std::optional<Tracer> tracer;
  std::optional<PixelSampler> sampler;
};

AntiAliasing grid(int depth, double jitter = 0) {
  return {1, depth, 0.3, jitter, true, {}};
}
AntiAliasing corners(int depth, double threshold = 0.3) {
  return {2, depth, threshold, 0, true, {}};
}

TEST(PixelSampler, CentresAreTheMiddles) {
  // Pixel 1 reaches from 1 to 2.
  for (double const edge : {1.49, 1.51}) {
    Sampling s(edge_at(edge), {});
    auto const green = s.green(&PixelSampler::centres, {{0, 0}, {1, 3}, {2, 1}});
    EXPECT_EQ(green, (std::vector<double>{1, edge > 1.5 ? 1.0 : 0.0, 0}));
    EXPECT_EQ(s.taken(), 3);
  }
}

TEST(PixelSampler, AGridHasItsSamplesInTheMiddlesOfItsCells) {
  for (int const depth : {1, 2, 3, 5})
    for (double const share : {0.05, 0.32, 0.45, 0.72, 0.95}) {
      Sampling s(edge_at(1 + share), grid(depth));
      int below = 0;
      for (int i = 0; i < depth; ++i) below += (i + 0.5) / depth < share ? 1 : 0;
      auto const n = static_cast<double>(depth);
      EXPECT_NEAR(s.refined({{1, 2}})[0], below / n, 1e-14);
      EXPECT_EQ(s.taken(), static_cast<std::uint64_t>(depth * depth));
      // And the middle beside them.
      EXPECT_NEAR(s.refined({{1, 2}}, true)[0], (below * n + (share > 0.5 ? 1 : 0)) / (n * n + 1),
                  1e-14);
    }
}

TEST(PixelSampler, PixelsOfAGridTogetherAreThoseOfEach) {
  Sampling s(edge_at(1.4), grid(3, 1)), alone(edge_at(1.4), grid(3, 1));
  std::vector<Pixel> const pixels{{1, 0}, {3, 3}, {1, 2}, {0, 1}};
  auto const together = s.refined(pixels);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    EXPECT_EQ(alone.refined({pixels[k]})[0], together[k]);
  EXPECT_EQ(s.rays, alone.rays);
  for (Pixel const& pixel : pixels)
    EXPECT_EQ(s.rays[static_cast<std::size_t>(4 * pixel.y + pixel.x)], 9);
}

TEST(PixelSampler, JitterStaysInItsCellAndIsEachSamplesOwn) {
  // The samples of the middle column lie about its middle, by half the jitter times a cell.
  auto const in_middle = [](double share) {
    Sampling s(edge_at(1 + share), grid(3, 0.5));
    return 9 * s.refined({{1, 1}})[0] - 3;
  };
  EXPECT_NEAR(in_middle(0.5 - 0.25 / 3 - 1e-9), 0, 1e-12);
  EXPECT_NEAR(in_middle(0.5 + 0.25 / 3 + 1e-9), 3, 1e-12);
  // One after the other, not all at once.
  std::vector<bool> seen(4);
  for (int step = 0; step <= 100; ++step) {
    double const count = in_middle(0.5 + 0.25 / 3 * (step / 50.0 - 1));
    seen[static_cast<std::size_t>(std::lround(count))] = true;
  }
  EXPECT_EQ(seen, (std::vector<bool>{true, true, true, true}));
}

TEST(PixelSampler, UnevenPixelsAreDividedToTheDepth) {
  // White below 0.3 of pixel 1; halves of cells, from the corners' mean: 1/2; 1/4; 3/8; 5/16.
  struct Expected {
    int depth;
    double value;
    std::uint64_t samples;
  };
  // Samples: 2 x 2; 3 x 3; in the left half 3 x 5, beside 3; between 1/4 and 1/2 another 9 + 2 x 4.
  for (Expected const& expected : {Expected{1, 0.5, 4}, Expected{2, 0.25, 9},
                                   Expected{3, 0.375, 18}, Expected{4, 0.3125, 35}}) {
    Sampling s(edge_at(1.3), corners(expected.depth));
    EXPECT_NEAR(s.green(&PixelSampler::subdivided, {{1, 1}})[0], expected.value, 1e-14);
    EXPECT_EQ(s.taken(), expected.samples) << expected.depth;
  }
}

TEST(PixelSampler, DifferencesBelowTheThresholdAreLeft) {
  for (double const threshold : {2.9, 3.1}) { // white and black differ by 3
    Sampling s(edge_at(1.3), corners(2, threshold));
    EXPECT_EQ(s.green(&PixelSampler::subdivided, {{1, 1}})[0], threshold < 3 ? 0.25 : 0.5);
  }
}

TEST(PixelSampler, NeighboursShareTheirCorners) {
  Sampling s(edge_at(9), corners(3));
  s.green(&PixelSampler::subdivided, {{0, 0}, {1, 0}});
  EXPECT_EQ(s.taken(), 6);
  s.green(&PixelSampler::subdivided, {{1, 1}}); // of which two are there
  EXPECT_EQ(s.taken(), 8);
  s.green(&PixelSampler::subdivided, {{0, 0}});
  EXPECT_EQ(s.taken(), 8);
}

TEST(PixelSampler, NeighboursShareWhatIsWithinThem) {
  // Pixels above each other: 3 x 3 and 3 x 2 more.
  Sampling s(edge_at(1.3), corners(2));
  auto const green = s.green(&PixelSampler::subdivided, {{1, 1}, {1, 2}});
  EXPECT_EQ(green, (std::vector<double>{0.25, 0.25}));
  EXPECT_EQ(s.taken(), 15);
}

/// Glass whose light hangs on random numbers.
struct Glass : Sampling {
  explicit Glass(AntiAliasing const& anti_aliasing)
      : Sampling(wedge(n_sf11(), stochastic({0, Jitter::Uniform, 1, Follow::Hero}), 8),
                 anti_aliasing) {}
};

TEST(PixelSampler, RandomNumbersHangOnThePlaceAlone) {
  std::vector<Pixel> pixels, backwards;
  for (int k = 0; k < 16; ++k) pixels.push_back({k % 4, k / 4});
  backwards.assign(pixels.rbegin(), pixels.rend());
  for (auto const& [anti_aliasing, work] :
       {std::pair(AntiAliasing{}, &PixelSampler::centres),
        std::pair(corners(3, 0.01), &PixelSampler::subdivided)}) {
    auto const all = Glass(anti_aliasing).green(work, pixels);
    auto last_first = Glass(anti_aliasing).green(work, backwards);
    std::reverse(last_first.begin(), last_first.end());
    EXPECT_EQ(last_first, all);
    Glass one_by_one(anti_aliasing);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(one_by_one.green(work, {pixels[k]})[0], all[k]);
  }
}

TEST(PixelSampler, SaysWhereLightIsWrong) {
  auto scene = edge_at(9);
  scene.objects[0].texture->front().finish->ambient.rgb =
      Vec3(std::numeric_limits<double>::infinity());
  Sampling centres(scene, {}, true);
  EXPECT_FALSE(centres.sampler->wrong());
  centres.green(&PixelSampler::centres, {{3, 2}, {1, 2}, {2, 1}});
  ASSERT_TRUE(centres.sampler->wrong());
  auto const& wrong = *centres.sampler->wrong(); // the first in rows
  EXPECT_EQ(wrong.pixel.x, 2);
  EXPECT_EQ(wrong.pixel.y, 1);
  EXPECT_EQ(wrong.x, 2.5);
  EXPECT_EQ(wrong.y, 1.5);
  EXPECT_EQ(wrong.key.number, 0);
  Sampling refined(scene, grid(4), true);
  refined.refined({{2, 1}});
  ASSERT_TRUE(refined.sampler->wrong());
  EXPECT_EQ(refined.sampler->wrong()->x, 2.125);
  EXPECT_EQ(refined.sampler->wrong()->y, 1.125);
  EXPECT_EQ(refined.sampler->wrong()->key.number, 1); // 0 is that of the middle
  EXPECT_EQ(refined.sampler->wrong()->key.pixel.bits(), wrong.key.pixel.bits());
}

} // namespace
} // namespace abbe::render::testing
